#include "common/hash.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>

#include "common/error.hpp"

namespace chute {

struct Hash::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~State() { EVP_MD_CTX_free(context); }
};

Hash::Hash() : state_(std::make_unique<State>()) {
  if (!state_->context || EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) != 1)
    throw WorkError("SHA-256 cannot be had from the system's library");
}
Hash::~Hash() = default;

void Hash::add(std::string_view bytes) { EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()); }

std::string Hash::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  EVP_DigestFinal_ex(state_->context, digest.data(), &size);
  std::string text;
  for (unsigned k = 0; k < size; ++k) text += fmt::format("{:02x}", digest[k]);
  return text;
}

std::string hash_of(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.hex();
}

const std::string& build_hash() {
  static const std::string once = [] {
    Hash hash;
    std::ifstream self("/proc/self/exe", std::ios::binary);
    std::array<char, 1 << 16> buffer;
    while (self.read(buffer.data(), buffer.size()), self.gcount() > 0)
      hash.add({buffer.data(), static_cast<std::size_t>(self.gcount())});
    return hash.hex();
  }();
  return once;
}

}  // namespace chute
