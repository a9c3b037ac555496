#include "measure/avalanches.hpp"

#include <fmt/format.h>

#include <map>

namespace chute::measure {
namespace {

/// The distribution of sizes, exactly: each size that came, and how often.
class Sizes final : public Remembering<Sizes> {
 public:
  Sizes(const RunContext& run, double from) : run_(run), first_(run.schedule(from, 0).step_of(0)) {}

  /// Looks now and then, so that not too many wait to be counted.
  std::int64_t next_after(std::int64_t step) const override {
    constexpr std::int64_t most_waiting = 100'000;
    return first_ > step ? first_ : step + most_waiting;
  }
  bool wants_avalanches(std::int64_t step) const override { return step >= first_; }
  void look(const Look& look) override {
    for (const auto& a : look.avalanches)
      if (a.update >= first_) ++count_[a.size];
  }
  void write(const Flow&) const override {
    struct Row {
      double size, count;
    };
    std::vector<Row> rows;
    double all = 0, mean = 0;
    for (const auto& [size, count] : count_) {
      rows.push_back({static_cast<double>(size), static_cast<double>(count)});
      all += static_cast<double>(count), mean += static_cast<double>(size * count);
    }
    Columns<Row> columns;
    columns.add("size", &Row::size).add("count", &Row::count);
    auto comments = run_.comments(
        "avalanches of a pile: topplings after one grain was added, and how often so many came");
    comments.push_back(fmt::format("{} avalanches, mean size {}", all, all > 0 ? mean / all : 0));
    run_.write("avalanches.csv", columns.csv(comments, rows));
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(count_);
  }

 private:
  const RunContext& run_;
  std::int64_t first_;
  std::map<std::int64_t, std::int64_t> count_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> AvalanchesOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Sizes>(run, spec->from));
  return observers;
}

}  // namespace chute::measure
