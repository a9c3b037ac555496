#include "common/share_folder.hpp"

namespace chute {

std::filesystem::path share_folder() {
  // The kernel's link leads to the file itself even where the program was called by another link to it.
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  return program.parent_path().parent_path() / "share" / "chute";
}

}  // namespace chute
