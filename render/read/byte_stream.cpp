#include "read/byte_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <mutex>
#include <optional>

#include "common/error.hpp"

namespace chute::read {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t block_size = 1U << 20U;  // bytes that are read, or unpacked, at once
// What was read of a packed file lately and is kept, so that frames of a trail are not unpacked again: bytes in all.
constexpr std::size_t most_kept = 64U << 20U;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

class Descriptor {
 public:
  explicit Descriptor(const fs::path& path) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ < 0) fail(path, fmt::format("cannot read: {}", std::strerror(errno)));
    if (::fstat(file_, &state_) == 0 && S_ISDIR(state_.st_mode))
      ::close(file_), fail(path, "cannot read: is a directory");
  }
  ~Descriptor() { ::close(file_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  /// Fewer than `size` at the end of the file only. Processes that were forked share the file's own place: it is not used.
  std::size_t read(char* to, std::size_t size, std::uint64_t from) const {
    std::size_t done = 0;
    while (done < size) {
      const auto got = ::pread(file_, to + done, size - done, static_cast<off_t>(from + done));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) fail(path_, fmt::format("cannot read: {}", std::strerror(errno)));
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    return done;
  }
  const struct stat& state() const { return state_; }

 private:
  fs::path path_;
  int file_;
  struct stat state_ {};
};

enum class Packing { none, gzip, zstd };

Packing packing_of(std::string_view begin) {
  if (begin.starts_with("\x1f\x8b")) return Packing::gzip;
  if (begin.starts_with("\x28\xb5\x2f\xfd")) return Packing::zstd;
  return Packing::none;
}

}  // namespace

struct ByteStream::Inside {
  fs::path path;
  Descriptor file;
  Packing packing = Packing::none;
  std::string packed, plain;
  std::uint64_t at = 0;         ///< bytes of the file that were read
  std::size_t used = 0;         ///< of `packed`
  bool between_members = true;  ///< nothing is missing if the file ends here
  bool full = false;            ///< the last block was
  z_stream gzip{};
  std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> zstd{nullptr, ZSTD_freeDStream};

  explicit Inside(const fs::path& p) : path(p), file(p) {
    char begin[4];
    packing = packing_of({begin, file.read(begin, sizeof begin, 0)});
    if (packing == Packing::gzip && inflateInit2(&gzip, 15 + 16) != Z_OK)
      throw WorkError("no memory to unpack a file");
    if (packing == Packing::zstd) {
      zstd.reset(ZSTD_createDStream());
      if (!zstd) throw WorkError("no memory to unpack a file");
    }
    plain.resize(block_size);
  }
  ~Inside() {
    if (packing == Packing::gzip) inflateEnd(&gzip);
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  bool refill() {
    packed.resize(block_size);
    packed.resize(file.read(packed.data(), block_size, at));
    at += packed.size(), used = 0;
    return !packed.empty();
  }

  std::size_t inflate_some() {
    gzip.next_in = reinterpret_cast<Bytef*>(packed.data() + used);
    gzip.avail_in = static_cast<uInt>(packed.size() - used);
    gzip.next_out = reinterpret_cast<Bytef*>(plain.data());
    gzip.avail_out = static_cast<uInt>(plain.size());
    between_members = false;
    const int state = ::inflate(&gzip, Z_NO_FLUSH);
    used = packed.size() - gzip.avail_in;
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      fail(path, fmt::format("damaged: gzip says {}", gzip.msg ? gzip.msg : "no more than that"));
    if (state == Z_STREAM_END) between_members = true, inflateReset(&gzip);
    return plain.size() - gzip.avail_out;
  }

  std::size_t unzstd_some() {
    ZSTD_inBuffer in{packed.data(), packed.size(), used};
    ZSTD_outBuffer out{plain.data(), plain.size(), 0};
    const std::size_t state = ZSTD_decompressStream(zstd.get(), &out, &in);
    if (ZSTD_isError(state)) fail(path, fmt::format("damaged: zstd says {}", ZSTD_getErrorName(state)));
    used = in.pos, between_members = state == 0;
    return out.pos;
  }

  std::string_view next() {
    if (packing == Packing::none) {
      const std::size_t got = file.read(plain.data(), block_size, at);
      at += got;
      return {plain.data(), got};
    }
    for (;;) {
      // What is behind the end of a member may be the next one; zeros that fill a tape's block are not.
      // Output that filled the block may have left more of it inside the unpacker.
      const bool more_inside = full && !between_members;
      if (used == packed.size() && !more_inside && !refill()) {
        if (!between_members) fail(path, "cut short: what was packed does not end");
        return {};
      }
      if (between_members && packing == Packing::gzip && packed[used] == '\0') {
        ++used;
        continue;
      }
      const std::size_t got = packing == Packing::gzip ? inflate_some() : unzstd_some();
      full = got == plain.size();
      if (got > 0) return {plain.data(), got};
    }
  }
};

ByteStream::ByteStream(const fs::path& path) : inside_(std::make_unique<Inside>(path)) {}
ByteStream::~ByteStream() = default;
std::string_view ByteStream::next() { return inside_->next(); }
bool ByteStream::is_packed() const { return inside_->packing != Packing::none; }

Lines::Lines(const fs::path& path) : path_(path), stream_(path) {}

bool Lines::next(std::string_view& line) {
  kept_.clear();
  for (;;) {
    if (block_.empty()) block_ = stream_.next();
    const bool ends = block_.empty();
    const auto end = block_.find('\n');
    const auto part = block_.substr(0, end);
    if (kept_.size() + part.size() > longest_line)
      throw InputError(
          fmt::format("{}:{}: a line of more than {} bytes", path_.string(), number_, longest_line));
    if (end == std::string_view::npos && !ends) {
      kept_ += part, block_ = {};
      continue;
    }
    if (ends && kept_.empty()) return false;
    if (kept_.empty()) {
      line = part;
    } else {
      kept_ += part;
      line = kept_;
    }
    position_ += line.size() + (ends ? 0 : 1), ++number_;
    open_ = ends;
    block_.remove_prefix(ends ? 0 : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
  }
}

std::uint64_t Lines::skip(std::uint64_t count) {
  std::string_view line;
  for (std::uint64_t i = 0; i < count; ++i)
    if (!next(line)) return i;
  return count;
}

std::string read_unpacked(const fs::path& path) {
  ByteStream stream(path);
  std::string bytes;
  std::error_code error;
  if (const auto size = fs::file_size(path, error); !error && !stream.is_packed()) bytes.reserve(size);
  for (auto some = stream.next(); !some.empty(); some = stream.next()) bytes += some;
  bytes.shrink_to_fit();
  return bytes;
}

namespace {

/// A packed file that is being read in pieces.
struct Unpacking {
  fs::path path;
  struct stat state;
  std::unique_ptr<ByteStream> stream;
  std::string_view block;
  std::uint64_t at = 0;  ///< place of `block` in what the file holds
  struct Piece {
    std::uint64_t from;
    std::string bytes;
  };
  std::deque<Piece> recent;
  std::size_t kept = 0;

  bool is_of(const fs::path& p, const struct stat& s) const {
    return stream && path == p && s.st_size == state.st_size && s.st_mtim.tv_sec == state.st_mtim.tv_sec &&
           s.st_mtim.tv_nsec == state.st_mtim.tv_nsec && s.st_ino == state.st_ino;
  }

  std::string piece(std::uint64_t from, std::uint64_t size) {
    for (const auto& old : recent)
      if (old.from == from && old.bytes.size() == size) return old.bytes;
    if (from < at) stream = std::make_unique<ByteStream>(path), block = {}, at = 0;
    std::string bytes;
    while (bytes.size() < size) {
      if (block.empty()) block = stream->next();
      if (block.empty()) fail(path, "it has become shorter while it was read");
      const auto before = std::min<std::uint64_t>(block.size(), at < from ? from - at : 0);
      block.remove_prefix(before), at += before;
      const auto some = block.substr(0, size - bytes.size());
      if (at < from) continue;
      bytes += some;
      block.remove_prefix(some.size()), at += some.size();
    }
    recent.push_back({from, bytes}), kept += bytes.size();
    while (recent.size() > 1 && kept > most_kept) kept -= recent.front().bytes.size(), recent.pop_front();
    return bytes;
  }
};

}  // namespace

std::string read_piece(const fs::path& path, std::uint64_t from, std::uint64_t size) {
  static std::mutex mutex;
  static Unpacking last;  // of one file at a time: a sequence is read in order
  const Descriptor file(path);
  char begin[4];
  if (packing_of({begin, file.read(begin, sizeof begin, 0)}) != Packing::none) {
    const std::lock_guard lock(mutex);
    if (!last.is_of(path, file.state())) {
      last = {};
      last.path = path, last.state = file.state(), last.stream = std::make_unique<ByteStream>(path);
    }
    return last.piece(from, size);
  }
  const auto length = static_cast<std::uint64_t>(file.state().st_size);
  if (from > length || size > length - from) fail(path, "it has become shorter while it was read");
  std::string bytes(size, '\0');
  if (file.read(bytes.data(), size, from) < size) fail(path, "it has become shorter while it was read");
  return bytes;
}

}  // namespace chute::read
