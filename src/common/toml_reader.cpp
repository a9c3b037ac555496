#include "common/toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

#include "common/error.hpp"

namespace chute {

bool Range::contains(double x) const {
  return std::isfinite(x) && (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Range::describe() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (has_low && has_high)
    return fmt::format("in {}{}, {}{}", low_open ? '(' : '[', low, high, high_open ? ')' : ']');
  if (has_low) return fmt::format("{} {}", low_open ? ">" : ">=", low);
  if (has_high) return fmt::format("{} {}", high_open ? "<" : "<=", high);
  return "finite";
}

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row.back();
}

std::string shown(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& n) { text << n; });
  auto s = text.str();
  return s.size() > 60 ? s.substr(0, 57) + "..." : s;
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : known) {
    const auto distance = edit_distance(word, candidate);
    if (distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

/// The library goes down one call a part of a dotted key or a bracket, and so would the stack.
static void refuse_depth(std::string_view text, const std::string& name) {
  constexpr std::size_t deepest = 64;
  std::size_t line = 1, dots = 0, open = 0;
  std::string_view quote;  // that the text is inside of: one or three
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line, dots = 0, comment = false;
    if (comment) continue;
    if (!quote.empty()) {
      if (c == '\\' && quote[0] == '"') ++i;
      if (text.substr(i).starts_with(quote)) i += quote.size() - 1, quote = {};
      continue;
    }
    if (c == '"' || c == '\'') {
      const auto three = text.substr(i, 3);
      quote = three == "\"\"\"" || three == "\'\'\'" ? three : three.substr(0, 1);
      i += quote.size() - 1;
    }
    comment = c == '#';
    dots = c == '.' ? dots + 1 : c == '=' || c == ',' || c == '[' || c == '{' ? 0 : dots;
    if (c == '[' || c == '{') ++open;
    if ((c == ']' || c == '}') && open > 0) --open;
    if (std::max(dots, open) > deepest)
      throw InputError(fmt::format("{}:{}: more than {} levels deep", name, line, deepest));
  }
}

toml::table parse_toml(std::string_view text, const std::string& name) {
  refuse_depth(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not TOML: {}", name, error.source().begin.line, error.description()));
  }
}

/// The table that `part` names within `inside`: one that is made if it is not there, or the n-th of an array, `wall[n]`.
static toml::table& enter_part(toml::table& inside, std::string_view part, const std::string& name) {
  const auto bracket = part.find('[');
  if (bracket == std::string_view::npos) {
    auto* next = inside.get(part);
    if (!next || !next->is_table()) next = &inside.insert_or_assign(part, toml::table{}).first->second;
    return *next->as_table();
  }
  std::size_t index = 0;
  const auto *begin = part.data() + bracket + 1, *end = part.data() + part.size();
  const auto [rest, error] = std::from_chars(begin, end, index);
  auto* node = inside.get(part.substr(0, bracket));
  auto* array = node ? node->as_array() : nullptr;
  if (error != std::errc() || std::string_view(rest, static_cast<std::size_t>(end - rest)) != "]" || !array ||
      index >= array->size() || !(*array)[index].is_table())
    throw InputError(fmt::format("{}: there is no table {}", name, part));
  return *(*array)[index].as_table();
}

void set_by_path(toml::table& table, std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(fmt::format("--set {}: expected key=value", assignment));
  const std::string key(assignment.substr(0, equals)), value(assignment.substr(equals + 1));
  const std::string name = "--set " + key;
  toml::table parsed;
  refuse_depth(assignment, "--set");
  const bool removes = value.empty();
  if (!removes) try {
      parsed = toml::parse("value = " + value, name);
    } catch (const toml::parse_error&) {
      try {
        parsed = toml::parse(fmt::format("value = '{}'", value), name);  // a plain word
      } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}: not a TOML value: {}", name, error.description()));
      }
    }
  toml::table* inside = &table;
  std::string_view rest = key;
  for (;;) {
    const auto dot = rest.find('.');
    const auto part = rest.substr(0, dot);
    if (part.empty()) throw InputError(name + ": empty key");
    if (dot == std::string_view::npos) {
      if (removes) {
        inside->erase(part);
        return;
      }
      inside->insert_or_assign(part, std::move(*parsed.get("value")));
      return;
    }
    inside = &enter_part(*inside, part, name);
    rest.remove_prefix(dot + 1);
  }
}

TomlReader::TomlReader(const toml::table& table, std::string document, std::string prefix)
    : table_(&table), document_(std::move(document)), prefix_(std::move(prefix)) {}

std::string TomlReader::path(std::string_view key) const {
  return prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key);
}

std::string TomlReader::where(const toml::node* node) const {
  const toml::source_region& source = node->source();
  if (source.path && source.path->starts_with("--set")) return *source.path + ": ";
  if (source.begin.line == 0) return document_ + ": ";
  return fmt::format("{}:{}: ", document_, source.begin.line);
}

/// The line that an error at a key is.
std::string TomlReader::line_of(std::string_view key, const std::string& message) const {
  const toml::node* node = table_->at_path(key).node();
  if (!node && key.find('.') == key.npos)
    for (const auto& [other, slip] : *table_) {  // it may be absent because of a slip of the pen
      if (std::find(known_.begin(), known_.end(), other.str()) != known_.end()) continue;
      if (edit_distance(other.str(), key) <=
          std::max(key.size() / 3, std::min<std::size_t>(2, key.size() / 2)))
        return where(&slip) + path(other.str()) + fmt::format(": unknown key, did you mean {}?", key);
    }
  for (auto inside = key; !node && inside.find('.') != inside.npos;) {  // at the table that should hold it
    inside = inside.substr(0, inside.rfind('.'));
    node = table_->at_path(inside).node();
  }
  return where(node ? node : table_) + path(key) + ": " + message;
}

void TomlReader::throw_slips() const {
  if (slips_ && !slips_->lines.empty()) throw InputError(fmt::format("{}", fmt::join(slips_->lines, "\n")));
}

void TomlReader::slip_line(const std::string& at, const std::string& line) const {
  if (!slips_) throw InputError(line);
  if (std::find(slips_->lines.begin(), slips_->lines.end(), line) != slips_->lines.end()) return;
  constexpr std::size_t most = 10;
  slips_->paths.push_back(at);
  slips_->lines.push_back(line);
  if (slips_->lines.size() == most) throw_slips();
}

void TomlReader::slip(std::string_view key, const std::string& message) const {
  slip_line(path(key), line_of(key, message));
}

/// Is there a slip already that this one may follow from: in the same table, or in the one that the key names?
bool TomlReader::follows_from_others(std::string_view key) const {
  const auto own = path(key);
  return slips_ && std::ranges::any_of(slips_->paths, [&](const std::string& other) {
           const auto dot = other.rfind('.');
           return (dot == other.npos ? "" : other.substr(0, dot)) == prefix_ || other == own ||
                  other.starts_with(own + ".");
         });
}

void TomlReader::stop(std::string_view key, const std::string& line) const {
  if (!slips_) throw InputError(line);
  if (!follows_from_others(key)) slip_line(path(key), line);
  throw SlipTold(fmt::format("{}", fmt::join(slips_->lines, "\n")));
}

void TomlReader::fail(std::string_view key, const std::string& message) const {
  stop(key, line_of(key, message));
}

void TomlReader::missing(std::string_view key) const {
  // The file's own tables are read one after the other: those still to come are not unknown, whatever they resemble.
  for (const auto& [other, node] : *table_) {
    if (prefix_.empty() && node.is_table()) continue;
    if (std::find(known_.begin(), known_.end(), other.str()) != known_.end()) continue;
    const auto hint = nearest(other.str(), known_);
    if (!hint.empty() && !has(hint))
      return slip_line(path(other.str()),
                       where(&node) + path(other.str()) + ": unknown key, did you mean " + hint + "?");
  }
  slip(key, "missing, but required");
}

void TomlReader::find_slip() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    const auto hint = nearest(key.str(), known_);
    if (!hint.empty() && !has(hint))
      stop(key.str(), where(&node) + path(key.str()) + ": unknown key, did you mean " + hint + "?");
  }
}

void TomlReader::know(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
}

std::optional<std::string> TomlReader::wrong(double x, Range range) const {
  if (!range.contains(x)) return fmt::format("is not allowed, must be {}", range.describe());
  if (physics_ && x != 0 && !computable.contains(std::abs(x)))
    return fmt::format("cannot be computed with: a number is 0 or {}", computable.describe());
  return {};
}

void TomlReader::value(std::string_view key, double& target, Range range, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  if (!node->is_number()) return slip(key, fmt::format("{} is not a number", shown(*node)));
  const double x = *node->value<double>();
  if (const auto why = wrong(x, range)) return slip(key, fmt::format("{} {}", x, *why));
  target = x;
}

void TomlReader::number_or_word(std::string_view key, std::optional<double>& target, std::string_view word,
                                Range range, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  if (node->is_number()) return value(key, target.emplace(), range);
  if (node->value<std::string_view>() != word)
    return slip(key, fmt::format("{} is neither a number nor \"{}\"", shown(*node), word));
  target.reset();
}

void TomlReader::value(std::string_view key, std::int64_t& target, Range range, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  if (!node->is_integer()) return slip(key, fmt::format("{} is not a whole number", shown(*node)));
  const auto x = *node->value<std::int64_t>();
  if (!range.contains(static_cast<double>(x)))
    return slip(key, fmt::format("{} is not allowed, must be {}", x, range.describe()));
  target = x;
}

void TomlReader::value(std::string_view key, bool& target, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  if (!node->is_boolean()) return slip(key, fmt::format("{} is not true or false", shown(*node)));
  target = *node->value<bool>();
}

void TomlReader::value(std::string_view key, std::string& target, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  if (!node->is_string()) return slip(key, fmt::format("{} is not a text in quotes", shown(*node)));
  target = *node->value<std::string>();
}

void TomlReader::value(std::string_view key, std::vector<double>& target, Range range, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array) return slip(key, fmt::format("{} is not a list of numbers", shown(*node)));
  target.clear();
  for (const toml::node& item : *array) {
    if (!item.is_number()) return slip(key, fmt::format("{} in the list is not a number", shown(item)));
    const double x = *item.value<double>();
    if (const auto why = wrong(x, range)) return slip(key, fmt::format("{} in the list {}", x, *why));
    target.push_back(x);
  }
}

void TomlReader::value(std::string_view key, std::vector<std::string>& target, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array) return slip(key, fmt::format("{} is not a list of texts", shown(*node)));
  target.clear();
  for (const toml::node& item : *array) {
    if (!item.is_string())
      return slip(key, fmt::format("{} in the list is not a text in quotes", shown(item)));
    target.push_back(*item.value<std::string>());
  }
}

void TomlReader::value(std::string_view key, std::vector<std::vector<double>>& target, Text) {
  know(key);
  const toml::node* node = table_->get(key);
  if (!node) return;
  const toml::array* places = node->as_array();
  if (!places) return slip(key, fmt::format("{} is not a list of places, [[0, 0], [1, 0]]", shown(*node)));
  target.clear();
  for (const toml::node& item : *places) {
    const toml::array* numbers = item.as_array();
    if (!numbers) return slip(key, fmt::format("{} in the list is not a place, [0, 0]", shown(item)));
    auto& place = target.emplace_back();
    for (const toml::node& number : *numbers) {
      if (!number.is_number()) return slip(key, fmt::format("{} in the list is not a number", shown(number)));
      const double x = *number.value<double>();
      if (const auto why = wrong(x, any_number)) return slip(key, fmt::format("{} in the list {}", x, *why));
      place.push_back(x);
    }
  }
}

int TomlReader::choose(std::string_view key, int current, std::span<const std::string_view> words) {
  know(key);
  if (!has(key)) return current;
  if (!table_->get(key)->is_string())
    fail(key, fmt::format("{} is not a text in quotes", shown(*table_->get(key))));
  const std::string word = *table_->get(key)->value<std::string>();
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == word) return static_cast<int>(i);
  const std::vector<std::string> known(words.begin(), words.end());
  const auto hint = nearest(word, known);
  const auto message =
      fmt::format("\"{}\" is not known{}, allowed: {}", word,
                  hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint), fmt::join(words, ", "));
  // Which keys there are besides follows from it: nothing more can be said.
  slip(key, message);
  throw InputError(fmt::format("{}", fmt::join(slips_->lines, "\n")));
}

TomlReader TomlReader::enter(std::string_view key) const {
  const toml::table* inside = table_->get(key)->as_table();
  if (!inside) fail(key, "must be a table: [" + path(key) + "]");
  TomlReader reader(*inside, document_, path(key));
  reader.slips_ = slips_;
  reader.physics_ = physics_;
  return reader;
}

TomlReader TomlReader::enter(std::string_view key, std::size_t index) const {
  const toml::array& array = *table_->get(key)->as_array();
  const toml::table* inside = array.get(index)->as_table();
  if (!inside) fail(key, "must be a list of tables: [[" + path(key) + "]]");
  TomlReader reader(*inside, document_, fmt::format("{}[{}]", path(key), index));
  reader.slips_ = slips_;
  reader.physics_ = physics_;
  return reader;
}

std::size_t TomlReader::count(std::string_view key) const {
  const toml::array* array = table_->get(key)->as_array();
  if (!array) fail(key, "must be a list of tables: [[" + path(key) + "]]");
  return array->size();
}

void TomlReader::finish() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    auto hint = nearest(key.str(), known_);
    if (elsewhere_)  // a name that is one in a table says more than one that is only like it
      for (const auto& name : elsewhere_())
        if (name.ends_with("." + std::string(key.str()))) {
          hint = name;
          break;
        }
    slip_line(path(key.str()), where(&node) + path(key.str()) + ": unknown key" +
                                   (hint.empty() ? fmt::format(", known: {}", fmt::join(known_, ", "))
                                                 : fmt::format(", did you mean {}?", hint)));
  }
}

namespace {

std::string toml_text(double x) {
  auto text = fmt::format("{}", x);
  return text.find_first_of(".e") == text.npos ? text + ".0" : text;
}
std::string toml_text(const std::string& word) {
  std::ostringstream out;
  out << toml::value<std::string>(word);  // quotes and escapes
  return std::move(out).str();
}
template <class T>
std::string toml_list(const std::vector<T>& values);
std::string toml_text(const std::vector<double>& place) { return toml_list(place); }
template <class T>
std::string toml_list(const std::vector<T>& values) {
  std::vector<std::string> texts;
  for (const auto& v : values) texts.push_back(toml_text(v));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

void TomlWriter::line(std::string_view key, const std::string& value) {
  lines_ += fmt::format("{} = {}\n", key, value);
}
void TomlWriter::value(std::string_view key, double value, Range, Text) { line(key, toml_text(value)); }
void TomlWriter::value(std::string_view key, std::int64_t value, Range, Text) {
  line(key, fmt::format("{}", value));
}
void TomlWriter::value(std::string_view key, bool value, Text) { line(key, value ? "true" : "false"); }
void TomlWriter::value(std::string_view key, const std::string& value, Text) { line(key, toml_text(value)); }
void TomlWriter::value(std::string_view key, const std::vector<double>& values, Range, Text) {
  line(key, toml_list(values));
}
void TomlWriter::value(std::string_view key, const std::vector<std::string>& values, Text) {
  line(key, toml_list(values));
}
void TomlWriter::value(std::string_view key, const std::vector<std::vector<double>>& values, Text) {
  line(key, toml_list(values));
}

}  // namespace chute
