#include "io/checkpoint_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <streambuf>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::io {
namespace {

constexpr std::string_view magic = "chute checkpoint 3\n";
constexpr std::size_t trailer = 8;  // the sum, in hexadecimal

std::uint32_t add_to_sum(std::uint32_t sum, std::string_view bytes) {
  if (bytes.empty()) return sum;  // an empty array has no address, to which zlib answers by starting again
  return static_cast<std::uint32_t>(crc32_z(sum, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Passes bytes on to a file and sums them.
class Summing : public std::streambuf {
 public:
  explicit Summing(std::filebuf& file) : file_(file) {}
  std::uint32_t sum() const { return sum_; }

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    sum_ = add_to_sum(sum_, {bytes, static_cast<std::size_t>(count)});
    return file_.sputn(bytes, count);
  }
  int_type overflow(int_type byte) override {
    const char c = traits_type::to_char_type(byte);
    return xsputn(&c, 1) == 1 ? byte : traits_type::eof();
  }

 private:
  std::filebuf& file_;
  std::uint32_t sum_ = 0;
};

std::string head(const std::string& scene) { return fmt::format("{}{:016x}{}", magic, scene.size(), scene); }

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const std::string& scene,
                      const std::function<void(std::ostream&)>& save) {
  replace_atomically(path, [&](const std::filesystem::path& temporary) {
    std::filebuf file;
    bool good = file.open(temporary, std::ios::out | std::ios::binary | std::ios::trunc) != nullptr;
    if (good) {
      Summing summing(file);
      std::ostream out(&summing);
      out << head(scene);
      save(out);
      const auto sum = fmt::format("{:08x}", summing.sum());
      good = out.good() && file.sputn(sum.data(), trailer) == trailer;
      good = file.close() != nullptr && good;
    }
    if (!good) throw WorkError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
  });
}

std::string read_checkpoint(const std::filesystem::path& path, const std::string& scene) {
  std::string content = read_file(path);
  const auto fail = [&](std::string_view what) {
    throw InputError(fmt::format("{}: {}", path.string(), what));
  };
  if (!content.starts_with(magic)) fail("not a checkpoint of this version of chute");
  if (content.size() < magic.size() + 16 + trailer) fail("truncated");
  const std::string_view body = std::string_view(content).substr(0, content.size() - trailer);
  if (fmt::format("{:08x}", add_to_sum(0, body)) != std::string_view(content).substr(body.size()))
    fail("truncated or damaged: its checksum does not match");
  const auto expected = head(scene);
  if (!body.starts_with(expected)) fail("belongs to another scene");
  content.resize(body.size());
  content.erase(0, expected.size());
  return content;
}

}  // namespace chute::io
