#include "engines/contact/solver/sweep_order.hpp"

#include <array>
#include <bit>
#include <numeric>

namespace chute::contact {

std::vector<std::uint32_t> SweepOrder::places() const {
  std::vector<std::uint32_t> places(size());
  for (std::size_t k = 0; k < size(); ++k) places[contacts[k]] = static_cast<std::uint32_t>(k);
  return places;
}

SweepOrder natural_order(std::size_t contacts) {
  SweepOrder order;
  order.contacts.resize(contacts);
  std::iota(order.contacts.begin(), order.contacts.end(), 0u);
  order.ends = {contacts};
  order.serial_rest = true;
  return order;
}

namespace {

// A word of bits says which colours a body, or a contact's neighbours, have met. A body with more contacts
// than that, such as a big one among small ones, sends the rest of them to the last colour, which one thread
// solves.
constexpr unsigned rest = 63;
using Colours = std::uint64_t;

/// `met(i)` are the colours that contact i must not have; `mark(i, colour)` tells those whom it concerns.
template <class Met, class Mark>
SweepOrder greedy(std::size_t contacts, const Met& met, const Mark& mark) {
  std::vector<std::uint8_t> colour(contacts);
  std::array<std::size_t, rest + 1> count{};
  for (std::size_t i = 0; i < contacts; ++i) {
    const auto c = std::min(rest, static_cast<unsigned>(std::countr_one(met(i))));
    colour[i] = static_cast<std::uint8_t>(c);
    ++count[c];
    mark(i, Colours{1} << c);
  }
  SweepOrder order;
  order.contacts.resize(contacts);
  std::array<std::size_t, rest + 1> next{};
  for (std::size_t c = 0, begin = 0; c <= rest; ++c) {
    next[c] = begin;
    begin += count[c];
    if (count[c]) order.ends.push_back(begin);
  }
  order.serial_rest = count[rest] > 0;
  for (std::size_t i = 0; i < contacts; ++i)
    order.contacts[next[colour[i]]++] = static_cast<std::uint32_t>(i);
  return order;
}

}  // namespace

SweepOrder coloured_by_rows(std::span<const std::size_t> row_starts, std::span<const std::uint32_t> columns) {
  std::vector<Colours> own(row_starts.size() - 1, 0);
  const auto met = [&](std::size_t i) {
    Colours all = 0;
    for (auto k = row_starts[i]; k < row_starts[i + 1]; ++k) all |= own[columns[k]];
    return all;
  };
  return greedy(own.size(), met, [&](std::size_t i, Colours colour) { own[i] = colour; });
}

SweepOrder coloured_by_bodies(std::span<const std::int32_t> a, std::span<const std::int32_t> b,
                              std::size_t bodies) {
  std::vector<Colours> met(bodies + 1, 0);  // the last: of no body, kept empty
  const auto of = [&](std::int32_t body) { return body < 0 ? bodies : static_cast<std::size_t>(body); };
  return greedy(
      a.size(), [&](std::size_t i) { return met[of(a[i])] | met[of(b[i])]; },
      [&](std::size_t i, Colours colour) {
        for (const auto body : {a[i], b[i]})
          if (body >= 0) met[of(body)] |= colour;
      });
}

}  // namespace chute::contact
