#pragma once
#include <functional>
#include <string>

namespace chute {

/// Runs `work` in a process of its own and gives what it returned. An exception in it comes back as InputError with its
/// text, and so does its end by a signal or by more than `most_bytes` of memory, as `when_it_dies`: for libraries that
/// do not survive every input.
std::string in_child(const std::function<std::string()>& work, const std::string& when_it_dies,
                     std::size_t most_bytes = std::size_t{8} << 30);

}  // namespace chute
