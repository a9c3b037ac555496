#pragma once
#include <toml++/toml.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "common/range.hpp"

/// Reading validated TOML. A type describes its keys once:
///
///     template <class Archive> void describe(Archive& a, Bed& bed) {
///       a.required("diameter", bed.diameter, positive);
///       a.value("count", bed.count, at_least(1));        // keeps the default that `bed` holds
///     }
///
/// and that one list reads it (TomlReader), writes it back complete (TomlWriter), tells which keys there are and what
/// they mean (KeyLister in common/keys.hpp), and knows which keys exist, so that a slip of the pen is answered with the
/// file, the line and the nearest key. The last argument of value, required and choice may be a text that explains the
/// key to users.
namespace chute {

/// What a key means, for users.
struct Text {
  const char* words = "";
  Text() = default;
  Text(const char* w) : words(w) {}
};

/// The known word closest to `word` if it looks like a slip of it, else empty.
std::string nearest(std::string_view word, std::span<const std::string> known);

/// Reads TOML text; InputError `NAME:LINE: …` if it is not TOML.
toml::table parse_toml(std::string_view text, const std::string& name);

/// Applies `key.path=value` (a TOML value, or else a plain word) to the table; `key.path=` removes the key.
/// InputError if it is not of that form.
void set_by_path(toml::table& table, std::string_view assignment);

/// A slip that was collected: what is read besides goes on.
struct SlipTold : InputError {
  using InputError::InputError;
};

class TomlReader {
 public:
  /// `table` and `document` must outlive the reader. `prefix` is the dotted path of the table, empty for the
  /// root.
  TomlReader(const toml::table& table, std::string document, std::string prefix = "");

  static constexpr bool reading = true;

  /// From now on slips are collected, here and in the tables inside, and reading goes on after each where it can;
  /// `throw_slips` throws them, a line each, ten at most. What is called after a slip must be ready for defaults.
  void collect() { slips_ = std::make_shared<Slips>(); }
  void throw_slips() const;
  /// From now on numbers, here and in the tables inside, are physical ones: 0, or of a size that is computable.
  void expect_physics() { physics_ = true; }
  /// Dotted names of keys that stand in tables, for the hint on one that stands outside of its own.
  void know_elsewhere(std::function<std::vector<std::string>()> names) { elsewhere_ = std::move(names); }

  bool has(std::string_view key) const { return table_->contains(key); }
  bool has_table(std::string_view key) const { return has(key) && table_->get(key)->is_table(); }

  void value(std::string_view key, double& target, Range range = any_number, Text = {});
  void value(std::string_view key, std::int64_t& target, Range range = any_number, Text = {});
  void value(std::string_view key, bool& target, Text = {});
  void value(std::string_view key, std::string& target, Text = {});
  void value(std::string_view key, std::vector<double>& target, Range range = any_number, Text = {});
  void value(std::string_view key, std::vector<std::string>& target, Text = {});
  /// A list of places: [[0, 0], [1, 0]].
  void value(std::string_view key, std::vector<std::vector<double>>& target, Text = {});
  /// Numbers without a range may have a text right away.
  template <class T>
  void value(std::string_view key, T& target, const char* text) {
    value(key, target, any_number, Text(text));
  }
  void value(std::string_view key, bool& target, const char*) { value(key, target); }
  void value(std::string_view key, std::string& target, const char*) { value(key, target); }
  void value(std::string_view key, std::vector<std::string>& target, const char*) { value(key, target); }

  template <class T>
  void value(std::string_view key, std::optional<T>& target, Range range = any_number, Text = {}) {
    know(key);
    if (!has(key)) return;
    T read{};
    if constexpr (std::same_as<T, double> || std::same_as<T, std::int64_t> ||
                  std::same_as<T, std::vector<double>>)
      value(key, read, range);
    else
      value(key, read);
    target = std::move(read);
  }

  /// A number, or the given word, which leaves `target` empty.
  void number_or_word(std::string_view key, std::optional<double>& target, std::string_view word,
                      Range range = any_number, Text = {});
  /// A key that others use, and that is allowed here without a meaning.
  void ignored(std::string_view key) { know(key); }

  template <class T, class... Rule>
  void required(std::string_view key, T& target, Rule... rule) {
    know(key);
    if (!has(key)) return missing(key);
    value(key, target, rule...);
  }

  /// One word out of `words`, stored as an enum whose values count from 0 in the same order.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void choice(std::string_view key, Enum& target, std::span<const std::string_view> words, Text = {}) {
    target = static_cast<Enum>(choose(key, static_cast<int>(target), words));
  }
  /// One word out of `words`, as its number; `current` if the key is absent.
  int choose(std::string_view key, int current, std::span<const std::string_view> words);

  /// A sub-table; kept as it is if absent.
  template <class T>
  void section(std::string_view key, T& target) {
    know(key);
    if (!has(key)) return;
    TomlReader inside = enter(key);
    inside.go_on_after_slips([&] {
      describe(inside, target);
      inside.finish();
    });
  }
  template <class T>
  void section(std::string_view key, std::optional<T>& target) {
    know(key);
    if (!has(key)) return;
    section(key, target.emplace());
  }
  template <class T>
  void required_section(std::string_view key, T& target) {
    know(key);
    if (!has(key)) return missing(key);
    section(key, target);
  }
  /// An array of tables: [[panel]].
  template <class T>
  void sections(std::string_view key, std::vector<T>& target) {
    know(key);
    if (!has(key)) return;
    target.clear();
    for (std::size_t i = 0; i < count(key); ++i) {
      TomlReader inside = enter(key, i);
      inside.go_on_after_slips([&] {
        describe(inside, target.emplace_back());
        inside.finish();
      });
    }
  }

  /// Refuses keys that nobody asked for.
  void finish() const;

  /// InputError at `key`, which may be a dotted path (or at the table that should hold it, if it is absent).
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

  /// A rule that only the reader needs (checks between keys).
  void check(bool holds, std::string_view key, const std::string& message) const {
    if (holds) return;
    find_slip();
    fail(key, message);
  }

 private:
  struct Slips {
    std::vector<std::string> paths, lines;
  };
  const toml::table* table_;
  std::string document_, prefix_;
  std::vector<std::string> known_;
  std::shared_ptr<Slips> slips_;
  bool physics_ = false;
  std::function<std::vector<std::string>()> elsewhere_;

  template <class Work>
  void go_on_after_slips(Work&& work) {
    if (!slips_) return work();
    try {
      work();
    } catch (const SlipTold&) {
      // It is among the slips.
    }
  }
  /// What is wrong at a key: thrown, or collected.
  void slip(std::string_view key, const std::string& message) const;
  void slip_line(const std::string& path, const std::string& line) const;
  std::string line_of(std::string_view key, const std::string& message) const;
  [[noreturn]] void stop(std::string_view key, const std::string& line) const;
  bool follows_from_others(std::string_view key) const;

  void know(std::string_view key);
  /// Why a number cannot be used; nothing if it can.
  std::optional<std::string> wrong(double x, Range range) const;
  /// A key that is missing may be there under a misspelt name: then that is what to say.
  void find_slip() const;
  void missing(std::string_view key) const;
  TomlReader enter(std::string_view key) const;
  TomlReader enter(std::string_view key, std::size_t index) const;
  std::size_t count(std::string_view key) const;
  std::string path(std::string_view key) const;
  std::string where(const toml::node* node) const;
};

/// Writes what TomlReader reads, every key with its value, in the order of the description (toml++ would sort
/// the keys and write 0.1 as 0.10000000000000001). Numbers are the shortest text that reads back the same.
class TomlWriter {
 public:
  static constexpr bool reading = false;

  void value(std::string_view key, double value, Range = any_number, Text = {});
  void value(std::string_view key, std::int64_t value, Range = any_number, Text = {});
  void value(std::string_view key, bool value, Text = {});
  void value(std::string_view key, const std::string& value, Text = {});
  void value(std::string_view key, const std::vector<double>& values, Range = any_number, Text = {});
  void value(std::string_view key, const std::vector<std::string>& values, Text = {});
  void value(std::string_view key, const std::vector<std::vector<double>>& values, Text = {});
  template <class T>
  void value(std::string_view key, const T& v, const char*) {
    value(key, v);
  }
  template <class T>
  void value(std::string_view key, const std::optional<T>& optional, const char*) {
    if (optional) value(key, *optional);
  }
  template <class T, class... Rule>
  void value(std::string_view key, const std::optional<T>& optional, Rule... rule) {
    if (optional) value(key, *optional, rule...);
  }
  void number_or_word(std::string_view key, const std::optional<double>& optional, std::string_view word,
                      Range = any_number, Text = {}) {
    optional ? value(key, *optional) : value(key, std::string(word));
  }
  void ignored(std::string_view) {}
  template <class T, class... Rule>
  void required(std::string_view key, const T& v, Rule... rule) {
    value(key, v, rule...);
  }
  template <class Enum>
  void choice(std::string_view key, Enum& target, std::span<const std::string_view> words, Text = {}) {
    value(key, std::string(words[static_cast<std::size_t>(target)]));
  }
  template <class T>
  void section(std::string_view key, T& target) {
    TomlWriter inside(prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key));
    describe(inside, target);
    sections_ += "\n[" + inside.prefix_ + "]\n" + inside.text();
  }
  template <class T>
  void section(std::string_view key, std::optional<T>& target) {
    if (target) section(key, *target);
  }
  template <class T>
  void required_section(std::string_view key, T& target) {
    section(key, target);
  }
  template <class T>
  void sections(std::string_view key, std::vector<T>& target) {
    for (auto& element : target) {
      TomlWriter inside(prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key));
      describe(inside, element);
      sections_ += "\n[[" + inside.prefix_ + "]]\n" + inside.text();
    }
  }
  void check(bool, std::string_view, const std::string&) const {}

  TomlWriter() = default;
  std::string text() const { return lines_ + sections_; }

 private:
  explicit TomlWriter(std::string prefix) : prefix_(std::move(prefix)) {}
  std::string prefix_, lines_, sections_;
  void line(std::string_view key, const std::string& value);
};

}  // namespace chute
