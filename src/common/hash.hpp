#pragma once
#include <memory>
#include <string>
#include <string_view>

namespace chute {

/// The one hash of chute, SHA-256: strong enough that two different things never share a name or a sum.
class Hash {
 public:
  Hash();
  ~Hash();
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;
  void add(std::string_view bytes);
  std::string hex();  ///< of everything so far, 64 digits; nothing can be added after it

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string hash_of(std::string_view bytes);

/// Hash of the program's own code and libraries of this build, such that what another build made is not taken for its
/// own: of the running executable's file.
const std::string& build_hash();

}  // namespace chute
