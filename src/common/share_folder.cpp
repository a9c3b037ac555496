#include "common/share_folder.hpp"

namespace chute {

namespace {

std::filesystem::path prefix() {
  // The kernel's link leads to the file itself even where the program was called by another link to it.
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

}  // namespace

std::filesystem::path share_folder() { return prefix() / "share" / "chute"; }

std::filesystem::path module_folder() { return prefix() / "lib" / "chute"; }

}  // namespace chute
