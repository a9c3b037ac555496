#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/team.hpp"

namespace chute::contact {

/// The order in which a sweep visits the contacts. Contacts of one colour share no moving body, so that they
/// may be solved at the same time, by any number of threads, with the same bytes. The order depends on the
/// problem alone.
struct SweepOrder {
  std::vector<std::uint32_t> contacts;  ///< place in a sweep -> contact
  std::vector<std::size_t> ends;        ///< of each colour, ascending
  bool serial_rest = false;             ///< the last colour's contacts may touch each other: one thread

  std::size_t size() const { return contacts.size(); }
  /// Where each contact stands in a sweep.
  std::vector<std::uint32_t> places() const;

  /// work(place) for all places, colour by colour.
  template <class Work>
  void visit(Team& team, const Work& work) const {
    std::size_t begin = 0;
    for (std::size_t c = 0; c < ends.size(); ++c) {
      const auto end = ends[c];
      const bool alone =
          team.size() == 1 || end - begin < worth_sharing || (serial_rest && c + 1 == ends.size());
      if (alone)
        for (auto place = begin; place < end; ++place) work(place);
      else
        team.split(end - begin, [&, begin](Part part, std::size_t) {
          for (auto place = begin + part.begin; place < begin + part.end; ++place) work(place);
        });
      begin = end;
    }
  }

 private:
  /// Contacts of a colour below which waking the team takes longer than solving them, at some 20 ns each.
  static constexpr std::size_t worth_sharing = 128;
};

/// One colour, as they come: for problems too small to be shared out. Contacts in their own order, mostly
/// from the ground up, converge in fewer sweeps than coloured ones.
SweepOrder natural_order(std::size_t contacts);

/// Greedy colours by contact order, of contacts that must not share a colour with those in their row.
SweepOrder coloured_by_rows(std::span<const std::size_t> row_starts, std::span<const std::uint32_t> columns);

/// Greedy colours by contact order, of contacts that must not share a body; −1 is none.
SweepOrder coloured_by_bodies(std::span<const std::int32_t> a, std::span<const std::int32_t> b,
                              std::size_t bodies);

/// Contacts below which a sweep is done by one thread in natural order.
inline constexpr std::size_t few_contacts = 2048;

}  // namespace chute::contact
