#include "view/color_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/toml_reader.hpp"

namespace chute::view {
namespace {

using Stop = ColorMap::Stop;

// Samples of the published 256-colour tables at the places named; straight lines between them stay within
// 3/255 of the tables. viridis and cividis: matplotlib's tables, CC0 (S. van der Walt, N. Smith; J. Nunez, C.
// Anderton, R. Renslow, PLoS ONE 13, e0199239, 2018). batlow: F. Crameri, Scientific colour maps, MIT licence
// (doi 10.5281/zenodo.1243862). rdbu: C. Brewer's RdBu with 11 classes from ColorBrewer, Apache licence 2.0,
// low values blue.
constexpr Stop viridis[] = {{0, {.267004, .004874, .329415}},   {15, {.281924, .089666, .412415}},
                            {30, {.280255, .165693, .476498}},  {45, {.263663, .237631, .518762}},
                            {60, {.237441, .305202, .541921}},  {75, {.208623, .367752, .552675}},
                            {90, {.182256, .426184, .557120}},  {105, {.159194, .482237, .558073}},
                            {120, {.137770, .537492, .554906}}, {135, {.121148, .592739, .544641}},
                            {150, {.128087, .647749, .523491}}, {165, {.180653, .701402, .488189}},
                            {180, {.274149, .751988, .436601}}, {195, {.395174, .797475, .367757}},
                            {210, {.535621, .835785, .281908}}, {225, {.688944, .865448, .182725}},
                            {233, {.772852, .877868, .131109}}, {240, {.845561, .887322, .099702}},
                            {243, {.876168, .891125, .095250}}, {247, {.916242, .896091, .100717}},
                            {255, {.993248, .906157, .143936}}};

constexpr Stop cividis[] = {{0, {0, .135112, .304751}},         {8, {0, .157932, .357521}},
                            {19, {0, .186915, .435532}},        {22, {0, .193366, .441561}},
                            {26, {.046205, .203903, .440196}},  {30, {.087465, .214879, .437342}},
                            {38, {.142852, .236972, .431404}},  {45, {.180503, .256180, .427299}},
                            {60, {.247605, .296986, .422917}},  {75, {.305886, .337681, .424512}},
                            {90, {.359916, .378641, .431501}},  {105, {.411607, .420145, .443577}},
                            {120, {.461616, .462405, .461969}}, {125, {.478186, .476699, .468845}},
                            {130, {.495913, .491076, .471751}}, {135, {.514226, .505546, .472640}},
                            {150, {.570607, .549695, .469593}}, {165, {.628576, .595104, .459641}},
                            {180, {.687957, .641966, .442886}}, {195, {.748772, .690470, .418448}},
                            {210, {.811054, .740801, .385198}}, {221, {.857809, .778969, .353259}},
                            {232, {.905589, .818257, .312889}}, {238, {.932180, .840159, .285880}},
                            {255, {.995737, .909344, .217772}}};

constexpr Stop batlow[] = {{0, {.005193, .098238, .349840}},   {15, {.047665, .185840, .364910}},
                           {30, {.064936, .255260, .376360}},  {45, {.083082, .311460, .383940}},
                           {60, {.118990, .362850, .382710}},  {75, {.182730, .405550, .361710}},
                           {90, {.266240, .438560, .320090}},  {105, {.358280, .467330, .269040}},
                           {120, {.455770, .495580, .217770}}, {135, {.562510, .524290, .176960}},
                           {150, {.678240, .550710, .177800}}, {165, {.790570, .571420, .236160}},
                           {180, {.889900, .592090, .330450}}, {195, {.961700, .624280, .455700}},
                           {210, {.990270, .667280, .593170}}, {225, {.992620, .710530, .720640}},
                           {240, {.988750, .753950, .846630}}, {255, {.981350, .800410, .981270}}};

constexpr Rgb bytes(int r, int g, int b) { return {r / 255., g / 255., b / 255.}; }
constexpr Stop rdbu[] = {
    {0, bytes(5, 48, 97)},       {26, bytes(33, 102, 172)},   {51, bytes(67, 147, 195)},
    {77, bytes(146, 197, 222)},  {102, bytes(209, 229, 240)}, {128, bytes(247, 247, 247)},
    {153, bytes(253, 219, 199)}, {179, bytes(244, 165, 130)}, {204, bytes(214, 96, 77)},
    {230, bytes(178, 24, 43)},   {255, bytes(103, 0, 31)}};

struct Named {
  std::string_view name;
  std::span<const Stop> stops;
};
constexpr Named maps[] = {{"viridis", viridis}, {"batlow", batlow}, {"cividis", cividis}, {"rdbu", rdbu}};

}  // namespace

Rgb mix(Rgb a, Rgb b, double t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

double brightness(Rgb color) { return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b; }

ColorMap::ColorMap(std::string_view name) {
  reversed_ = name.ends_with("_r");
  const auto plain = name.substr(0, name.size() - (reversed_ ? 2 : 0));
  const auto* found =
      std::find_if(std::begin(maps), std::end(maps), [&](const Named& m) { return m.name == plain; });
  if (found == std::end(maps)) {
    const auto hint = nearest(plain, names());
    throw InputError(fmt::format(
        "colour map \"{}\" is not known{}, allowed: {}, or one of them reversed: NAME_r", name,
        hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint), fmt::join(names(), ", ")));
  }
  name_ = found->name;
  stops_ = found->stops;
}

Rgb ColorMap::at(double t) const {
  if (reversed_) t = 1 - t;
  const double place = 255 * std::clamp(t, 0.0, 1.0);
  const auto above =
      std::find_if(stops_.begin() + 1, stops_.end() - 1, [&](const Stop& s) { return s.place >= place; });
  const auto& a = *(above - 1);
  return mix(mix(a.color, above->color, (place - a.place) / (above->place - a.place)), ground_, fade_);
}

ColorMap ColorMap::faded(Rgb ground, double share) const {
  ColorMap map = *this;
  map.ground_ = ground, map.fade_ = share;
  return map;
}

bool ColorMap::is_diverging() const { return name_ == "rdbu"; }

std::vector<std::string> ColorMap::names() {
  std::vector<std::string> result;
  for (const auto& map : maps) result.emplace_back(map.name);
  return result;
}

}  // namespace chute::view
