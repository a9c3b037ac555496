#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/toml_reader.hpp"

/// Kinds of things that a scene can name (beds, starts, engines, observers), each of which describes its own keys.
namespace chute {

/// Why something that a scene asks for cannot be, and which key to change.
struct Refusal {
  std::string key, message;
};

/// A key of a scene, as users read of it.
struct KeyText {
  std::string key, type, allowed, preset, text;
};

/// Goes over a description, as TomlReader does, and lists its keys.
class KeyLister {
 public:
  static constexpr bool reading = false;
  explicit KeyLister(std::string prefix = "") : prefix_(std::move(prefix)) {}
  const std::vector<KeyText>& keys() const { return keys_; }

  void value(std::string_view key, double v, Range range = any_number, Text text = {}) {
    add(key, "number", range_text(range), fmt::format("{}", v), text);
  }
  void value(std::string_view key, std::int64_t v, Range range = any_number, Text text = {}) {
    add(key, "whole number", range_text(range), fmt::format("{}", v), text);
  }
  // Without these two a number with a text but no range would be taken for a bool.
  void value(std::string_view key, double v, Text text) { value(key, v, any_number, text); }
  void value(std::string_view key, std::int64_t v, Text text) { value(key, v, any_number, text); }
  void value(std::string_view key, bool v, Text text = {}) {
    add(key, "true or false", "", v ? "true" : "false", text);
  }
  void value(std::string_view key, const std::string& v, Text text = {}) { add(key, "text", "", v, text); }
  void value(std::string_view key, const std::vector<double>& v, Range range = any_number, Text text = {}) {
    add(key, "numbers", range_text(range), v.empty() ? "" : fmt::format("{}", v), text);
  }
  void value(std::string_view key, const std::vector<std::string>& v, Text text = {}) {
    add(key, "texts", "", v.empty() ? "" : fmt::format("{}", v), text);
  }
  void value(std::string_view key, const std::vector<std::vector<double>>&, Text text = {}) {
    add(key, "places", "", "", text);
  }
  template <class T>
  void value(std::string_view key, const std::optional<T>& optional, const char* text) {
    value(key, optional.value_or(T{}), text);
    if (!optional) keys_.back().preset.clear();
  }
  template <class T>
  void value(std::string_view key, const T& v, const char* text) {
    if constexpr (std::same_as<T, double> || std::same_as<T, std::int64_t> ||
                  std::same_as<T, std::vector<double>>)
      value(key, v, any_number, Text(text));
    else
      value(key, v, Text(text));
  }
  template <class T, class... Rule>
  void value(std::string_view key, const std::optional<T>& optional, Rule... rule) {
    value(key, optional.value_or(T{}), rule...);
    if (!optional) keys_.back().preset.clear();
  }
  void number_or_word(std::string_view key, const std::optional<double>& optional, std::string_view word,
                      Range range = any_number, Text text = {}) {
    add(key, fmt::format("number or \"{}\"", word), range_text(range),
        optional ? fmt::format("{}", *optional) : std::string(word), text);
  }
  void ignored(std::string_view) {}
  template <class T, class... Rule>
  void required(std::string_view key, const T& v, Rule... rule) {
    value(key, v, rule...);
    keys_.back().preset = "required";
  }
  template <class Enum>
  void choice(std::string_view key, Enum& target, std::span<const std::string_view> words, Text text = {}) {
    add(key, "word", fmt::format("{}", fmt::join(words, ", ")),
        std::string(words[static_cast<std::size_t>(target)]), text);
  }
  template <class T>
  void section(std::string_view key, T& target) {
    KeyLister inside(path(key));
    describe(inside, target);
    keys_.insert(keys_.end(), inside.keys_.begin(), inside.keys_.end());
  }
  template <class T>
  void section(std::string_view key, std::optional<T>& target) {
    T whole = target.value_or(T{});
    section(key, whole);
  }
  template <class T>
  void required_section(std::string_view key, T& target) {
    section(key, target);
  }
  template <class T>
  void sections(std::string_view key, std::vector<T>&) {
    T element{};
    section(key, element);
  }
  void check(bool, std::string_view, const std::string&) const {}

 private:
  std::string prefix_;
  std::vector<KeyText> keys_;

  std::string path(std::string_view key) const {
    return prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key);
  }
  static std::string range_text(Range range) { return range.describe() == "finite" ? "" : range.describe(); }
  void add(std::string_view key, std::string type, std::string allowed, std::string preset, Text text) {
    // Where the text says what a missing key means, the value that stands for "missing" would contradict it.
    if (std::string_view(text.words).find("default") != std::string_view::npos) preset.clear();
    keys_.push_back({path(key), std::move(type), std::move(allowed), std::move(preset), text.words});
  }
};

/// What a scene says of one thing of some kind. Implement it by Described.
class Keys {
 public:
  virtual ~Keys() = default;
  virtual void read(TomlReader& a) = 0;
  virtual void write(TomlWriter& a) = 0;
  virtual void list(KeyLister& a) = 0;
};
inline void describe(TomlReader& a, Keys& keys) { keys.read(a); }
inline void describe(TomlWriter& a, Keys& keys) { keys.write(a); }
inline void describe(KeyLister& a, Keys& keys) { keys.list(a); }

/// A thing that derives from `Base`, whose kind `Base::Thing` derives from Keys and has a virtual `clone`, with its keys in one template member
/// `describe(Archive&)` of `Self`.
template <class Base, class Self>
class Described : public Base {
 public:
  void read(TomlReader& a) override { self().describe(a); }
  void write(TomlWriter& a) override { self().describe(a); }
  void list(KeyLister& a) override { self().describe(a); }
  std::unique_ptr<typename Base::Thing> clone() const override {
    return std::make_unique<Self>(static_cast<const Self&>(*this));
  }

 private:
  Self& self() { return static_cast<Self&>(*this); }
};

/// One entry of a list of kinds: its word in scenes, what it is, and how it is made with its defaults.
template <class Base>
struct Kind {
  std::string word, text;
  std::function<std::unique_ptr<Base>()> make;
};
/// The entry for a type that names itself by `word` and `text`.
template <class Base, class Self>
Kind<Base> kind_of() {
  return {std::string(Self::word), std::string(Self::text), [] { return std::make_unique<Self>(); }};
}
template <class Base>
using Catalogue = std::vector<Kind<Base>>;

/// One thing out of a catalogue: a value, copied with what it holds.
template <class Base>
class Chosen {
 public:
  Chosen() = default;
  explicit Chosen(const Kind<Base>& kind) : word_(kind.word), thing_(kind.make()) {}
  Chosen(const Chosen& other) : word_(other.word_), thing_(other.thing_ ? other.thing_->clone() : nullptr) {}
  Chosen(Chosen&&) noexcept = default;
  Chosen& operator=(Chosen other) {
    word_ = std::move(other.word_), thing_ = std::move(other.thing_);
    return *this;
  }
  const std::string& word() const { return word_; }
  const Base& operator*() const { return *thing_; }
  Base& operator*() { return *thing_; }
  const Base* operator->() const { return thing_.get(); }
  Base* operator->() { return thing_.get(); }
  /// As that type, or null.
  template <class Self>
  Self* as() {
    return dynamic_cast<Self*>(thing_.get());
  }
  template <class Self>
  const Self* as() const {
    return dynamic_cast<const Self*>(thing_.get());
  }

 private:
  std::string word_;
  std::unique_ptr<Base> thing_;
};

/// The word at `key` says which entry; it stays what it was (or is the first) if the key is absent.
template <class Base>
void choose_kind(TomlReader& a, std::string_view key, Chosen<Base>& chosen, const Catalogue<Base>& list) {
  std::vector<std::string_view> words;
  int current = 0;
  for (const auto& kind : list) {
    if (kind.word == chosen.word()) current = static_cast<int>(words.size());
    words.push_back(kind.word);
  }
  const auto which = static_cast<std::size_t>(a.choose(key, current, words));
  if (list[which].word != chosen.word()) chosen = Chosen<Base>(list[which]);
}
template <class Archive, class Base>
void choose_kind(Archive& a, std::string_view key, Chosen<Base>& chosen, const Catalogue<Base>&) {
  a.value(key, chosen.word());
}

}  // namespace chute
