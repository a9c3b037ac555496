#include "io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <charconv>
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

std::string block(const std::string& bytes) { return fmt::format("{:016x}{}", bytes.size(), bytes); }

/// Takes a block off the front of what is left; InputError by `fail` if it is longer than that.
template <class Fail>
std::string_view take_block(std::string_view& rest, const Fail& fail) {
  std::size_t size = 0;
  const auto* begin = rest.data();
  if (rest.size() < digits || std::from_chars(begin, begin + digits, size, 16).ptr != begin + digits)
    fail("truncated");
  rest.remove_prefix(digits);
  if (size > rest.size()) fail("truncated");
  const auto taken = rest.substr(0, size);
  rest.remove_prefix(size);
  return taken;
}

/// A checkpoint taken apart; the parts point into the content.
struct Parts {
  std::string content;
  std::string_view program, scene, grains, state;

  explicit Parts(const std::filesystem::path& path) : content(read_file(path)) {
    const auto fail = [&](std::string_view what) {
      throw InputError(fmt::format("{}: {}", path.string(), what));
    };
    if (!content.starts_with(magic)) fail("not a checkpoint of this version of chute");
    if (content.size() < magic.size() + trailer) fail("truncated");
    std::string_view rest = std::string_view(content).substr(0, content.size() - trailer);
    if (hash_of(rest) != std::string_view(content).substr(rest.size()))
      fail("truncated or damaged: its checksum does not match");
    rest.remove_prefix(magic.size());
    program = take_block(rest, fail);
    scene = take_block(rest, fail);
    grains = take_block(rest, fail);
    state = rest;
  }
};

}  // namespace

Temporary made_checkpoint(const std::filesystem::path& path, const CheckpointHead& head,
                          const std::string& grains, const std::function<void(std::ostream&)>& save) {
  Temporary file(path);
  Hashing hashing(file);
  std::ostream out(&hashing);
  out.exceptions(std::ios::badbit);  // a full disk is thrown on as it is
  out << magic << block(head.program) << block(head.scene) << block(grains);
  save(out);
  file.write(hashing.finish());
  return file;
}

void write_checkpoint(const std::filesystem::path& path, const CheckpointHead& head,
                      const std::string& grains, const std::function<void(std::ostream&)>& save) {
  auto file = made_checkpoint(path, head, grains, save);
  file.flush();
  file.move_into_place();
  flush_folder(folder_of(path));
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const Parts parts(path);
  return {std::string(parts.program), std::string(parts.scene), std::string(parts.state)};
}

void check_checkpoint(const std::filesystem::path& path) { const Parts parts(path); }

std::string read_checkpoint_grains(const std::filesystem::path& path) {
  return std::string(Parts(path).grains);
}

}  // namespace chute::io
