#pragma once
#include <cereal/archives/portable_binary.hpp>
#include <cstdint>
#include <istream>
#include <ranges>
#include <type_traits>
#include <vector>

#include "common/wrong_state.hpp"

/// How engines and observers write their state into checkpoints, and read it again. A checkpoint's hash says that nothing
/// happened to it, not that chute wrote it: what is read is held against what is there.
namespace chute {

using StateOutput = cereal::PortableBinaryOutputArchive;

/// Reads what StateOutput wrote. Before memory is taken for a list, there must be at least a byte for each of its elements:
/// a wrong length ends as InputError, as an early end does.
class StateInput : public cereal::InputArchive<StateInput, cereal::AllowEmptyClassElision> {
 public:
  explicit StateInput(std::istream& in) : InputArchive(this), in_(*in.rdbuf()) {
    const auto here = in_.pubseekoff(0, std::ios::cur, std::ios::in);
    const auto end = in_.pubseekoff(0, std::ios::end, std::ios::in);
    in_.pubseekpos(here, std::ios::in);
    left_ = end - here;
    std::uint8_t little = 0;
    (*this)(little);
    if (little != 1) wrong_state();  // every machine that Debian 12's chute runs on writes so
  }

  void take(void* to, std::uint64_t bytes) {
    must_hold(bytes);
    in_.sgetn(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    left_ -= static_cast<std::streamsize>(bytes);
  }
  void must_hold(std::uint64_t bytes) const {
    if (left_ < 0 || bytes > static_cast<std::uint64_t>(left_)) wrong_state();
  }

 private:
  std::streambuf& in_;
  std::streamsize left_ = 0;
};

// What cereal looks for by argument: numbers, lengths of lists, and blocks of numbers.
template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_LOAD_FUNCTION_NAME(StateInput& archive, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    std::uint8_t byte = 0;  // another value in a bool would be undefined
    archive.take(&byte, 1);
    value = byte != 0;
  } else {
    archive.take(&value, sizeof(T));
  }
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(StateInput& archive, cereal::NameValuePair<T>& named) {
  archive(named.value);
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(StateInput& archive, cereal::SizeTag<T>& tag) {
  archive.take(&tag.size, sizeof tag.size);
  archive.must_hold(tag.size);
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(StateInput& archive, cereal::BinaryData<T>& block) {
  archive.take(block.data, block.size);
}

/// InputError unless all numbers of a restored list name one of `count` things.
template <std::ranges::input_range Indices>
void must_name(const Indices& indices, std::size_t count) {
  for (const auto index : indices)
    if (index < 0 || static_cast<std::size_t>(index) >= count) wrong_state();
}

/// How long a list is, and the lists in it; of a table of columns (Grains), each column.
template <class T>
void note_lengths(const T& t, std::vector<std::size_t>& lengths) {
  if constexpr (std::ranges::sized_range<T>) {
    lengths.push_back(std::ranges::size(t));
    if constexpr (std::ranges::sized_range<std::ranges::range_value_t<T>>)
      for (const auto& each : t) note_lengths(each, lengths);
  } else {
    T::for_columns(t, [&](const auto&, const auto& column) { note_lengths(column, lengths); });
  }
}

/// Lists whose lengths follow from the scene: other lengths in a checkpoint are an InputError.
template <class T>
struct Kept {
  T& value;
  template <class Archive>
  void serialize(Archive& archive) {
    if constexpr (std::is_same_v<Archive, StateInput>) {
      std::vector<std::size_t> before, after;
      note_lengths(value, before);
      archive(value);
      note_lengths(value, after);
      if (before != after) wrong_state();
    } else {
      archive(value);
    }
  }
};
template <class T>
Kept<T> kept(T& value) {
  return {value};
}

}  // namespace chute

// What cereal asks of an archive that reads what another wrote.
template <>
struct cereal::traits::detail::get_output_from_input<chute::StateInput> {
  using type = chute::StateOutput;
};
