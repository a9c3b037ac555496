#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "targets.hpp"

/// fuzz_cases FOLDER: gives every file of FOLDER/NAME to the reader NAME. Ends with 1 if one does not end as it should, or
/// there is none; a signal ends it as well.
int main(int, char** arguments) {
  namespace fs = std::filesystem;
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds longest{10};  // a case may take; what is measured here are hangs, not speed
  int tried = 0, wrong = 0;
  for (const auto& target : chute::fuzz::targets) {
    const auto folder = fs::path(arguments[1]) / target.name;
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const auto bytes = chute::read_file(entry.path());
      const auto begin = Clock::now();
      std::string end = "read";
      try {
        target.read(bytes);
      } catch (const chute::InputError& error) {
        end = error.what();
      } catch (const chute::WorkError& error) {
        end = error.what();
      } catch (const std::exception& error) {
        end = fmt::format("WRONG: {}", error.what());
        ++wrong;
      }
      if (Clock::now() - begin > longest) {
        end += " WRONG: slow";
        ++wrong;
      }
      fmt::print("{}/{}: {}\n", target.name, entry.path().filename().string(), end);
      ++tried;
    }
  }
  fmt::print("{} tried, {} wrong\n", tried, wrong);
  return wrong > 0 || tried == 0;
}
