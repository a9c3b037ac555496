#pragma once
#include "plot/geometry.hpp"

/// How colours look to those who see fewer of them, and in print without any: what the palettes and the referee are held to.
namespace chute::plot {

/// As a deuteranope or a protanope sees it (Machado, Oliveira & Fernandes, IEEE Trans. Vis. Comput. Graph. 15, 1291
/// (2009), severity 1).
Color as_deuteranope(const Color& color);
Color as_protanope(const Color& color);

/// CIE 1976 L*a*b* under D65; L* from 0 to 100 is the grey that a printer without colours makes of it.
struct Lab {
  double l = 0, a = 0, b = 0;
};
Lab lab_of(const Color& color);

/// CIE 1976 colour difference: 2.3 is just seen side by side; small marks apart need some ten times that.
double difference(const Color& a, const Color& b);
/// How far apart their greys are, in L*.
double grey_difference(const Color& a, const Color& b);

}  // namespace chute::plot
