#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <string>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "engines/contact/problem/problem_file.hpp"
#include "engines/contact/solver/exact.hpp"
#include "engines/contact/solver/nsgs.hpp"

namespace {

using namespace chute;
using namespace chute::contact;

/// As chute's: 0 done, 1 the work failed, 2 the command or a given file is wrong.
enum Status { done = 0, failed = 1, wrong = 2 };

struct Wish {
  std::string file, solver = "nsgs", output;
  Goal goal;
  int threads = 1;
};

template <int D>
ExactSolution<D> solve(const Problem<D>& problem, const Wish& wish) {
  if (wish.solver == "exact") return exact(problem, wish.goal);
  Team team(wish.threads);
  AssembledSystem<D> system(problem);
  const auto convergence = nsgs(system, wish.goal, team);
  return {system.result(), convergence};
}

/// One number a line, contact by contact, normal first; enough digits to give the same double again.
template <int D>
void write(const std::string& path, std::span<const Vec<D>> r) {
  std::string text;
  for (const auto& impulse : r)
    for (const double x : impulse.c) text += fmt::format("{:.17g}\n", x);
  write_atomically(path, text);
}

template <int D>
void work(const Problem<D>& problem, const Wish& wish) {
  const auto begin = std::chrono::steady_clock::now();
  const auto solution = solve(problem, wish);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const auto& c = solution.convergence;
  fmt::print("{}: {} contacts in {} dimensions, {} blocks\n", wish.file, problem.size(), D,
             problem.blocks.size());
  fmt::print("{}: {} iterations, residual {:.3e}, {:.6f} s\n", wish.solver, c.iterations, c.residual,
             took.count());
  if (!c.reached)
    throw WorkError(fmt::format("{}: the residual is {:.3e} after {} iterations, not {:g}", wish.file,
                                c.residual, c.iterations, wish.goal.tolerance));
  if (!wish.output.empty()) write<D>(wish.output, solution.r);
}

int say(Status status, const std::string& what) {
  fmt::print(stderr, "contact_problem: {}\n", what);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "contact_problem solves a problem of frictional contact: FCLIB's HDF5 files and Siconos's text files."};
  app.name("contact_problem");
  Wish wish;
  wish.goal.iterations = 100'000;
  app.add_option("FILE", wish.file, "the problem")->required();
  app.add_option("--solver", wish.solver, "nsgs, or exact for up to 200 contacts")
      ->check(CLI::IsMember({"nsgs", "exact"}))
      ->capture_default_str();
  app.add_option("--tolerance", wish.goal.tolerance, "of the residual")
      ->check(CLI::Range(1e-15, 1.0))
      ->capture_default_str();
  app.add_option("--iterations", wish.goal.iterations, "at most: sweeps, or sets of states")
      ->check(CLI::Range(1L, 1'000'000'000L))
      ->capture_default_str();
  app.add_option("--threads", wish.threads, "the same bytes with any number")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("-o", wish.output,
                 "write the impulses, one number a line, contact by contact, normal first");
  app.footer("Example: contact_problem Capsules.hdf5 --tolerance 1e-10 -o impulses.txt");
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error that is told, as a full disk is
  try {
    app.parse(argc, argv);
    if (std::isnan(wish.goal.tolerance)) throw InputError("--tolerance: must be a number from 1e-15 to 1");
    std::visit([&](const auto& problem) { work(problem, wish); }, read_problem(wish.file));
    return done;
  } catch (const CLI::Success& asked) {  // --help
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    return say(wrong, error.what());
  } catch (const InputError& error) {
    return say(wrong, error.what());
  } catch (const std::bad_alloc&) {
    return say(failed, "out of memory");
  } catch (const std::exception& error) {
    return say(failed, error.what());
  }
}
