#include "io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <istream>
#include <ostream>
#include <streambuf>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"

namespace chute::io {
namespace {

constexpr std::string_view magic = "chute checkpoint 7\n";
constexpr std::size_t digits = 16;   // of a length, in hexadecimal
constexpr std::size_t trailer = 64;  // the hash, in hexadecimal

/// Passes bytes on to a file and hashes them. What goes wrong is thrown through the stream, which must ask for that.
class Hashing : public std::streambuf {
 public:
  explicit Hashing(Temporary& file) : file_(file) { waiting_.reserve(most); }
  /// The hash of everything, which is in the file by then.
  std::string finish() {
    pass_on();
    return hash_.hex();
  }

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    const std::string_view given(bytes, static_cast<std::size_t>(count));
    hash_.add(given);
    if (waiting_.size() + given.size() > most) pass_on();
    if (given.size() > most)
      file_.write(given);
    else
      waiting_.append(given);
    return count;
  }
  int_type overflow(int_type byte) override {
    const char c = traits_type::to_char_type(byte);
    return xsputn(&c, 1) == 1 ? byte : traits_type::eof();
  }

 private:
  static constexpr std::size_t most = 1 << 20;  // bytes that are written at once
  Temporary& file_;
  Hash hash_;
  std::string waiting_;

  void pass_on() {
    file_.write(waiting_);
    waiting_.clear();
  }
};

std::string digits_of(std::uint64_t size) { return fmt::format("{:016x}", size); }
std::string block(const std::string& bytes) { return digits_of(bytes.size()) + bytes; }

/// A checkpoint that is read from its file. What asks for the file's end finds the state's: the hash behind it is none of
/// its business.
class Reading : public std::filebuf {
 public:
  /// InputError that names the file if it is missing, truncated or damaged; else it stands before the first block.
  explicit Reading(const std::filesystem::path& path) : path_(path) {
    if (std::filesystem::is_directory(path)) errno = EISDIR;
    if (std::filesystem::is_directory(path) || !open(path, std::ios::in | std::ios::binary))
      throw InputError(fmt::format("{}: cannot read: {}", path.string(), std::strerror(errno)));
    const auto size = static_cast<std::uint64_t>(std::filebuf::seekoff(0, std::ios::end, std::ios::in));
    seekpos(0, std::ios::in);
    if (take(std::min<std::uint64_t>(size, magic.size())) != magic)
      fail("not a checkpoint of this version of chute");
    if (size < magic.size() + trailer) fail("truncated");
    left_ = size - magic.size() - trailer;
    check();
  }

  /// The next block. Its length is held against what is left before memory is taken.
  std::string take_block() { return take(block_length()); }
  void skip_block() {
    const auto length = block_length();
    std::filebuf::seekoff(static_cast<off_type>(length), std::ios::cur, std::ios::in);
    left_ -= length;
  }

 protected:
  pos_type seekoff(off_type off, std::ios::seekdir from, std::ios::openmode which) override {
    return std::filebuf::seekoff(from == std::ios::end ? off - static_cast<off_type>(trailer) : off, from,
                                 which);
  }

 private:
  std::filesystem::path path_;
  std::uint64_t left_ = 0;  // of the blocks and the state

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(fmt::format("{}: {}", path_.string(), what));
  }
  std::string take(std::uint64_t length) {
    std::string bytes(length, '\0');
    if (static_cast<std::uint64_t>(sgetn(bytes.data(), static_cast<std::streamsize>(length))) != length)
      fail("truncated");
    left_ -= std::min(left_, length);
    return bytes;
  }
  std::uint64_t block_length() {
    if (left_ < digits) fail("truncated");
    const auto text = take(digits);
    std::uint64_t length = 0;
    const auto* end = text.data() + text.size();
    if (std::from_chars(text.data(), end, length, 16).ptr != end || length > left_) fail("truncated");
    return length;
  }
  /// Reads all of it once, for its hash.
  void check() {
    constexpr std::uint64_t most = 1 << 20;
    Hash hash;
    hash.add(magic);
    for (auto rest = left_; rest > 0;) {
      const auto some = std::min(rest, most);
      hash.add(take(some));
      rest -= some;
    }
    if (take(trailer) != hash.hex()) fail("truncated or damaged: its checksum does not match");
    left_ = static_cast<std::uint64_t>(seekoff(0, std::ios::end, std::ios::in)) - magic.size();
    seekpos(static_cast<off_type>(magic.size()), std::ios::in);
  }
};

/// A stream that owns what it reads.
class OwningStream : public std::istream {
 public:
  explicit OwningStream(std::unique_ptr<Reading> file) : std::istream(file.get()), file_(std::move(file)) {}

 private:
  std::unique_ptr<Reading> file_;
};

}  // namespace

Temporary made_checkpoint(const std::filesystem::path& path, const CheckpointHead& head,
                          const Written& grains, const std::function<void(std::ostream&)>& save) {
  Temporary file(path);
  Hashing hashing(file);
  std::ostream out(&hashing);
  out.exceptions(std::ios::badbit);  // a full disk is thrown on as it is
  out << magic << block(head.program) << block(head.scene) << digits_of(grains.size);
  grains.write(out);
  save(out);
  file.write(hashing.finish());
  return file;
}

void write_checkpoint(const std::filesystem::path& path, const CheckpointHead& head, const Written& grains,
                      const std::function<void(std::ostream&)>& save) {
  auto file = made_checkpoint(path, head, grains, save);
  file.flush();
  file.move_into_place();
  flush_folder(folder_of(path));
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  auto file = std::make_unique<Reading>(path);
  Checkpoint checkpoint;
  checkpoint.program = file->take_block();
  checkpoint.scene = file->take_block();
  file->skip_block();
  checkpoint.state = std::make_unique<OwningStream>(std::move(file));
  return checkpoint;
}

void check_checkpoint(const std::filesystem::path& path) { read_checkpoint(path); }

std::string read_checkpoint_grains(const std::filesystem::path& path) {
  Reading file(path);
  file.skip_block();
  file.skip_block();
  return file.take_block();
}

}  // namespace chute::io
