#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>

#include "common/scratch_folder.hpp"

namespace chute::lammps {

/// LAMMPS at work: `lmp`, or `mpirun -n RANKS lmp`, that takes commands one after the other in a folder of its own, which goes with it.
class LammpsProcess {
 public:
  /// InputError, one line, if LAMMPS or mpirun is not there.
  explicit LammpsProcess(int ranks);
  ~LammpsProcess();
  LammpsProcess(const LammpsProcess&) = delete;
  LammpsProcess& operator=(const LammpsProcess&) = delete;

  const std::filesystem::path& folder() const { return scratch_.path(); }
  /// Gives it the commands and returns when they are done. WorkError with LAMMPS's own words if it stops.
  void command(const std::string& commands);

 private:
  ScratchFolder scratch_;
  pid_t process_ = -1;
  int input_ = -1;
  long long marks_ = 0;

  void start(int ranks);
  void send(std::string_view text);
  [[noreturn]] void fail();
  bool has_ended();
};

}  // namespace chute::lammps
