#pragma once
#include <filesystem>

namespace chute {

/// Folder of what comes with the program: `scenes`, and `fonts`. It is found from where the program lies, as
/// share/chute beside the folder bin, so that an installed program knows nothing of the tree that it was built
/// from and may be moved together with its share folder. A build folder has links at that place.
std::filesystem::path share_folder();

/// Folder of the libraries that the program loads when it needs them: lib/chute beside the folder bin.
std::filesystem::path module_folder();

}  // namespace chute
