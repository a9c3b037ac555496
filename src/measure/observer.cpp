#include "measure/observer.hpp"

#include "common/atomic_file.hpp"

namespace chute::measure {

std::vector<std::string> RunContext::comments(std::string what) const {
  return {std::move(what), title + "; " + made_by};
}

void RunContext::write(const std::string& name, const std::string& bytes) const {
  if (directory.empty()) return;
  const auto file = directory / name;
  std::filesystem::create_directories(file.parent_path());
  write_atomically(file, bytes);
}

}  // namespace chute::measure
