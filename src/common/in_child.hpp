#pragma once
#include <sys/types.h>

#include <functional>
#include <string>

namespace chute {

/// Work in a process of its own: for libraries that do not survive every input. To be started from a program that has no
/// other threads just then: what these hold locked stays locked in the child.
class Child {
 public:
  static constexpr std::size_t usual_most_bytes = std::size_t{8} << 30;

  /// Starts it. WorkError if no process can be had.
  Child(const std::function<std::string()>& work, std::string when_it_dies,
        std::size_t most_bytes = usual_most_bytes);
  ~Child();  ///< ends it, whatever it does, if its result was not asked for
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for what the work returned. An exception in it comes back as InputError with its text, and so does its end by a
  /// signal or by more than `most_bytes` of memory, as `when_it_dies`. WorkError if it was told to stop.
  std::string result();

 private:
  std::string when_it_dies_;
  pid_t process_ = -1;
  int from_ = -1;

  int wait();
};

/// Starts it and waits.
std::string in_child(const std::function<std::string()>& work, const std::string& when_it_dies,
                     std::size_t most_bytes = Child::usual_most_bytes);

}  // namespace chute
