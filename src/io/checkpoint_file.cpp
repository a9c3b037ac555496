#include "io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <streambuf>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"

namespace chute::io {
namespace {

constexpr std::string_view magic = "chute checkpoint 5\n";
constexpr std::size_t digits = 16;   // of a length, in hexadecimal
constexpr std::size_t trailer = 64;  // the hash, in hexadecimal

/// Passes bytes on to a file and hashes them.
class Hashing : public std::streambuf {
 public:
  explicit Hashing(std::filebuf& file) : file_(file) {}
  std::string hash() { return hash_.hex(); }

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    hash_.add({bytes, static_cast<std::size_t>(count)});
    return file_.sputn(bytes, count);
  }
  int_type overflow(int_type byte) override {
    const char c = traits_type::to_char_type(byte);
    return xsputn(&c, 1) == 1 ? byte : traits_type::eof();
  }

 private:
  std::filebuf& file_;
  Hash hash_;
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
  std::string_view scene, grains, state;

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
    scene = take_block(rest, fail);
    grains = take_block(rest, fail);
    state = rest;
  }
};

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const std::string& scene, const std::string& grains,
                      const std::function<void(std::ostream&)>& save) {
  replace_atomically(path, [&](const std::filesystem::path& temporary) {
    std::filebuf file;
    bool good = file.open(temporary, std::ios::out | std::ios::binary | std::ios::trunc) != nullptr;
    if (good) {
      Hashing hashing(file);
      std::ostream out(&hashing);
      out << magic << block(scene) << block(grains);
      save(out);
      const auto hash = hashing.hash();
      good = out.good() && file.sputn(hash.data(), trailer) == trailer;
      good = file.close() != nullptr && good;
    }
    if (!good) throw WorkError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
  });
}

std::string read_checkpoint(const std::filesystem::path& path, const std::string& scene) {
  const Parts parts(path);
  if (parts.scene != scene) throw InputError(path.string() + ": belongs to another scene");
  return std::string(parts.state);
}

std::string read_checkpoint_grains(const std::filesystem::path& path) {
  return std::string(Parts(path).grains);
}

}  // namespace chute::io
