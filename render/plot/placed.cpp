#include "plot/placed.hpp"

namespace chute::plot {
namespace {

/// Items as they are on the page that they are put on.
class Placing {
 public:
  Placing(double scale, const Point& at) : scale_(scale), at_(at) {}

  FillItem operator()(const FillItem& item) const { return {placed(item.path), item.color}; }
  StrokeItem operator()(StrokeItem item) const {
    item.path = placed(item.path);
    item.stroke.width *= scale_;
    for (double& d : item.stroke.dash) d *= scale_;
    return item;
  }
  GlyphRun operator()(GlyphRun run) const {
    run.origin = at_ + scale_ * run.origin;
    run.size *= scale_;
    for (auto& glyph : run.glyphs) glyph.at *= scale_;
    return run;
  }
  DotsItem operator()(DotsItem item) const {
    Path shape;
    item.shape = shape.append(item.shape, {0, 0}, scale_);
    for (Point& p : item.at) p = at_ + scale_ * p;
    return item;
  }
  PictureItem operator()(PictureItem item) const {
    item.rect = placed(item.rect);
    return item;
  }
  ClipBegin operator()(const ClipBegin& clip) const { return {placed(clip.rect)}; }
  ClipEnd operator()(const ClipEnd&) const { return {}; }

 private:
  double scale_;
  Point at_;

  Path placed(const Path& path) const { return Path{}.append(path, at_, scale_); }
  Rect placed(const Rect& r) const {
    return {at_.x() + scale_ * r.left, at_.y() + scale_ * r.top, at_.x() + scale_ * r.right,
            at_.y() + scale_ * r.bottom};
  }
};

}  // namespace

void place(DisplayList& page, const DisplayList& part, double scale, const Point& at) {
  const Placing placing(scale, at);
  for (const auto& item : part.items)
    std::visit([&](const auto& one) { page.items.emplace_back(placing(one)); }, item);
}

}  // namespace chute::plot
