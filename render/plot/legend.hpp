#pragma once
#include <map>
#include <string>
#include <vector>

#include "plot/layout.hpp"
#include "plot/marks.hpp"
#include "plot/mathtext.hpp"

namespace chute::plot {

/// "e_n=0.7 fine" as a label: "$e_n=0.7$, fine". Names of quantities become symbols (mu, Phi, eps_max,
/// k_s/k_n …), powers of ten and units of numbers are set, words stay words.
std::string label_from_name(const std::string& name);

/// The value of a factor as a label: what the figure says it is called, or as made from the name.
std::string label_of_factor(const Figure& figure, const std::string& value);

/// Samples and names of series in rows and columns.
class LegendBlock {
 public:
  LegendBlock(const Look& look, const std::map<std::string, SeriesLook>& looks)
      : look_(&look), looks_(&looks) {}

  /// Adds the series unless its name is there already or its label is empty. Doubtful parts have one entry for all.
  void add(const Series& series);
  /// Adds an entry for each value of the two factors of these series, in place of one for each series. Without
  /// `colors` only the second: the first is told at the curves.
  void add(const Figure& figure, const Factors& factors, const std::vector<const Series*>& series,
           bool colors);
  /// What hollow markers mean, where a whole series is told to be (parameters.hpp) and no part of its name says so.
  void add_hollow();
  std::size_t count() const { return entries_.size(); }

  double width(int columns) const;
  double height(int columns) const;
  /// As many columns as fit side by side, at least one.
  int columns_within(double width) const;
  void draw(DisplayList& list, Point top_left, int columns, int panel, std::vector<Box>& boxes) const;

 private:
  struct Entry {
    std::string name;  ///< of the series, or of what stands for several
    Kind kind;
    SeriesLook look;
    TextBox text;
    std::string source;
  };
  const Look* look_;
  const std::map<std::string, SeriesLook>* looks_;
  std::vector<Entry> entries_;

  SeriesLook any_hollow() const;
  bool has(const std::string& name) const;
  void put(const std::string& name, Kind kind, const SeriesLook& look, const std::string& label);
  int rows(int columns) const { return (static_cast<int>(entries_.size()) + columns - 1) / columns; }
  std::vector<double> column_widths(int columns) const;
  double row_height() const;
  double sample() const;  ///< width
  double gap() const { return 0.45 * look_->legend_size; }
};

}  // namespace chute::plot
