#include "measure/observer.hpp"

namespace chute::measure {

std::vector<std::string> RunContext::comments(std::string what) const {
  return {std::move(what), title + "; " + made_by};
}

void RunContext::write(const std::string& name, const std::string& bytes) const {
  if (files) files->write(name, bytes);
}
void RunContext::write_once(const std::string& name, const std::string& bytes) const {
  if (files) files->write_once(name, bytes);
}

}  // namespace chute::measure
