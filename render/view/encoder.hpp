#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace chute::view {

/// Another program that reads bytes from its standard input. Ended by force if it is not finished.
class Encoder {
 public:
  /// `arguments[0]` is looked for as the shell does. WorkError if it cannot be started.
  explicit Encoder(const std::vector<std::string>& arguments);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// WorkError with the last thing that the program said if it has stopped reading.
  void write(const void* bytes, std::size_t count);
  /// Waits for its end; WorkError if it failed or complained.
  void finish();

 private:
  std::string name_;
  int process_ = -1, input_ = -1, said_ = -1;

  std::string last_words() const;
  [[noreturn]] void fail();
  int wait();
};

}  // namespace chute::view
