#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "image/png.hpp"

using namespace chute;
using namespace chute::image;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("chute-png-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

Image pattern(int width, int height, bool transparent) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      auto* p = image.pixel(x, y);
      p[0] = std::uint8_t(x * 7), p[1] = std::uint8_t(y * 5), p[2] = std::uint8_t(x * y);
      p[3] = transparent ? std::uint8_t(x + y) : 255;
    }
  return image;
}

std::string message(const fs::path& path) {
  try {
    read_png(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a picture survives PNG, with and without alpha") {
  Folder folder;
  for (bool transparent : {false, true}) {
    const auto image = pattern(53, 31, transparent);
    write_png(folder.path / "a.png", image);
    REQUIRE(read_png(folder.path / "a.png") == image);
  }
  const auto opaque = encode_png(pattern(53, 31, false));
  REQUIRE(opaque[25] == 2);                             // colour type RGB
  REQUIRE(encode_png(pattern(53, 31, true))[25] == 6);  // RGBA
}

TEST_CASE("the same picture gives the same bytes, and text rides along") {
  Folder folder;
  const auto image = pattern(40, 40, false);
  const Text text{{"Title", "fig-4-05"}, {"Description", "v̄ against sin θ"}, {"Software", "chute 0.1.0"}};
  REQUIRE(encode_png(image, text) == encode_png(image, text));
  write_png(folder.path / "a.png", image, text, small_level, 300);
  const auto found = read_png_text(folder.path / "a.png");
  REQUIRE(found.size() == 3);
  REQUIRE(found.at("Title") == "fig-4-05");
  REQUIRE(found.at("Description") == "v̄ against sin θ");
  REQUIRE(read_png(folder.path / "a.png") == image);
}

TEST_CASE("a file that is no whole PNG is refused in one line that names it") {
  Folder folder;
  const auto path = folder.path / "bad.png";
  const auto bytes = encode_png(pattern(64, 64, false), {{"Title", "t"}});

  REQUIRE_THROWS_AS(read_png(folder.path / "none.png"), InputError);
  write_atomically(path, "");
  REQUIRE(message(path) == path.string() + ": the file is empty, not a PNG picture");
  write_atomically(path, "GIF89a and more");
  REQUIRE(message(path) == path.string() + ": not a PNG picture");
  for (std::size_t length = 1; length < bytes.size(); length += 7) {
    write_atomically(path, std::string_view(bytes).substr(0, length));
    REQUIRE(message(path).find(path.string() + ": ") == 0);
  }
  write_atomically(path, std::string_view(bytes).substr(0, bytes.size() - 1));
  REQUIRE(message(path) == path.string() + ": damaged PNG picture: cut short");
  auto flipped = bytes;
  flipped[bytes.size() / 2] ^= 0x10;
  write_atomically(path, flipped);
  REQUIRE(message(path).find("damaged PNG picture") != std::string::npos);
}

TEST_CASE("nothing stays behind where a picture cannot be written") {
  REQUIRE_THROWS_AS(write_png("/nonexistent-folder/a.png", pattern(4, 4, false)), WorkError);
  REQUIRE_THROWS_AS(encode_png(Image{}), WorkError);
}
