#include "image/png.hpp"
#include "in_memory.hpp"
#include "targets.hpp"

void chute::fuzz::picture(std::string_view bytes) {
  const FileInMemory file(bytes);
  image::read_png_text(file.path());
  image::read_png(file.path());
}
