#pragma once
#include <span>
#include <string>

namespace chute {

/// ParaView's index of files by time (.pvd): files[i] is of times[i].
std::string pvd(std::span<const double> times, std::span<const std::string> files);

}  // namespace chute
