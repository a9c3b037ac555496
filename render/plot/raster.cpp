#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <optional>

#include "common/error.hpp"
#include "plot/draw.hpp"
#include "plot/fonts.hpp"
#include "plot/gl_functions.hpp"
#include "plot/outline.hpp"

/// The pixel back end. Every path becomes triangles; the stencil buffer collects what they cover, then one
/// rectangle paints it ("stencil, then cover"), so that a path paints each sample once, however its triangles
/// overlap. Pixels are averages of n x n samples on a regular grid. The page is drawn tile by tile, so that
/// its size does not matter.
namespace chute::plot {
namespace {

constexpr int tile_pixels = 256;  // tiles of 256 pixels: the samples of one stay in the processor's cache

/// n x n samples per pixel. Coarse pictures need more: their lines are about a pixel wide.
int samples_for(double dpi) { return dpi < 200 ? 8 : 4; }

struct Operation {
  enum class Kind { winding, pen, dots } kind = Kind::winding;
  GLint first = 0;
  GLsizei count = 0;
  GLsizei clockwise = 0;  // winding: so many of the vertices, at the front
  Color color;
  Rect box;                   // samples
  std::optional<Rect> clip;   // samples
  std::vector<Point> places;  // dots: samples
};

/// The display list as triangles in sample coordinates.
class Compiler {
 public:
  Compiler(double scale) : scale_(scale) {}

  void add(const DisplayList& list) {
    for (const auto& item : list.items) std::visit([this](const auto& i) { add(i); }, item);
  }

  std::vector<float> vertices;
  std::vector<Operation> operations;

 private:
  double scale_;
  std::optional<Rect> clip_;
  std::vector<Point> triangles_;

  double tolerance() const { return 0.1 / scale_; }  // a tenth of a sample, in points

  void add(const ClipBegin& c) {
    // on whole samples, as the scissor cuts
    clip_ = Rect{std::round(c.rect.left * scale_), std::round(c.rect.top * scale_),
                 std::round(c.rect.right * scale_), std::round(c.rect.bottom * scale_)};
  }
  void add(const ClipEnd&) { clip_.reset(); }
  void add(const FillItem& item) {
    fan_triangles(flatten(item.path, tolerance()), triangles_);
    emit(Operation::Kind::winding, item.color);
  }
  void add(const StrokeItem& item) {
    pen_triangles(flatten(item.path, tolerance()), item.stroke, tolerance(), triangles_);
    emit(Operation::Kind::pen, item.color);
  }
  void add(const GlyphRun& run) {
    auto& fonts = Fonts::mine();
    const Eigen::Rotation2Dd turn(-run.angle);  // anticlockwise on a page whose y points down
    Path path;
    for (const auto& glyph : run.glyphs) path.append(fonts.outline(run.face, glyph.id), glyph.at, run.size);
    for (auto& p : path.points) p = run.origin + turn * p;
    fan_triangles(flatten(path, tolerance()), triangles_);
    emit(Operation::Kind::winding, run.color);
  }
  void add(const DotsItem& item) {
    fan_triangles(flatten(item.shape, tolerance() * 4), triangles_);
    if (item.at.empty()) return triangles_.clear();
    emit(Operation::Kind::dots, item.color);
    auto& places = operations.back().places;
    places.reserve(item.at.size());
    for (Point p : item.at) places.push_back(scale_ * p);
  }
  void add(const PictureItem&) { throw WorkError("a page that holds a picture is drawn by Cairo"); }
  void emit(Operation::Kind kind, Color color) {
    if (triangles_.empty()) return;
    Operation op{kind,
                 static_cast<GLint>(vertices.size() / 2),
                 static_cast<GLsizei>(triangles_.size()),
                 0,
                 color,
                 Rect::nothing(),
                 clip_,
                 {}};
    for (Point p : triangles_) op.box.include(scale_ * p);
    const auto put = [&](std::size_t corner) {
      const Point q = scale_ * triangles_[corner];
      vertices.push_back(static_cast<float>(q.x())), vertices.push_back(static_cast<float>(q.y()));
    };
    // Sorted by orientation here, so that the stencil needs no notion of sides: up first, down after.
    for (const bool clockwise : {true, false})
      for (std::size_t i = 0; i < triangles_.size(); i += 3) {
        const Point u = triangles_[i + 1] - triangles_[i], v = triangles_[i + 2] - triangles_[i];
        if ((u.x() * v.y() - u.y() * v.x() >= 0) != clockwise) continue;
        put(i), put(i + 1), put(i + 2);
        if (clockwise) op.clockwise += 3;
      }
    operations.push_back(std::move(op));
    triangles_.clear();
  }
};

// The colour goes through the vertices as a flat value, though it is one for the whole draw: with a flat
// value Mesa's llvmpipe gives up its search for pairs of triangles that make an upright rectangle, which
// in 22.3 takes some pairs that make none (a circumflex was filled) and drops others (a macron vanished).
constexpr const char* vertex_source = R"(#version 330 core
layout(location = 0) in vec2 corner;
layout(location = 1) in vec2 place;
uniform vec2 origin;
uniform vec2 scale;
uniform vec4 color;
flat out vec4 shade;
void main() {
  shade = color;
  gl_Position = vec4((corner + place - origin) * scale - 1.0, 0.0, 1.0);
}
)";
constexpr const char* fragment_source = R"(#version 330 core
flat in vec4 shade;
out vec4 painted;
void main() { painted = shade; }
)";

class Raster {
 public:
  Raster(int samples) : samples_(samples), side_(tile_pixels * samples) {
    program();
    target();
    GLuint array = 0;
    gl_.glGenVertexArrays(1, &array);
    gl_.glBindVertexArray(array);
    gl_.glGenBuffers(1, &triangles_);
    gl_.glGenBuffers(1, &cover_);
    gl_.glGenBuffers(1, &places_);
    gl_.glEnableVertexAttribArray(0);
    gl_.glEnable(GL_BLEND);
    gl_.glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // colours come multiplied by alpha
    gl_.glEnable(GL_SCISSOR_TEST);
    gl_.glViewport(0, 0, side_, side_);
    gl_.glPixelStorei(GL_PACK_ALIGNMENT, 1);
  }

  image::Image draw(const Compiler& page, int width, int height, Color background) {
    gl_.glBindBuffer(GL_ARRAY_BUFFER, triangles_);
    gl_.glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(page.vertices.size() * sizeof(float)),
                     page.vertices.data(), GL_STATIC_DRAW);
    image::Image picture(width, height);
    std::vector<std::uint8_t> samples(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * 4);
    for (int y = 0; y < height; y += tile_pixels)
      for (int x = 0; x < width; x += tile_pixels) {
        tile(page, x, y, background);
        gl_.glReadPixels(0, 0, side_, side_, GL_RGBA, GL_UNSIGNED_BYTE, samples.data());
        average(samples, picture, x, y);
      }
    if (const auto fault = gl_.glGetError(); fault != GL_NO_ERROR)
      throw WorkError("cannot draw: OpenGL error " + std::to_string(fault));
    return picture;
  }

 private:
  gl::KeepCurrent before_;
  gl::Context context_{16, 16, 0};  // its own buffer is never drawn to: there is a framebuffer, see target()
  GlFunctions gl_;
  int samples_, side_;
  GLuint triangles_ = 0, cover_ = 0, places_ = 0;
  GLint origin_ = 0, scale_ = 0, color_ = 0;

  void program() {
    const GLuint linked = gl_.glCreateProgram();
    for (const auto& [kind, source] : {std::pair{GLenum{GL_VERTEX_SHADER}, vertex_source},
                                       std::pair{GLenum{GL_FRAGMENT_SHADER}, fragment_source}}) {
      const GLuint shader = gl_.glCreateShader(kind);
      gl_.glShaderSource(shader, 1, &source, nullptr);
      gl_.glCompileShader(shader);
      gl_.glAttachShader(linked, shader);
    }
    gl_.glLinkProgram(linked);
    GLint good = 0;
    gl_.glGetProgramiv(linked, GL_LINK_STATUS, &good);
    if (!good) throw WorkError("cannot draw: OpenGL does not link the shaders");
    gl_.glUseProgram(linked);
    origin_ = gl_.glGetUniformLocation(linked, "origin");
    scale_ = gl_.glGetUniformLocation(linked, "scale");
    color_ = gl_.glGetUniformLocation(linked, "color");
  }

  void target() {
    GLuint frame = 0, buffers[2] = {};
    gl_.glGenFramebuffers(1, &frame);
    gl_.glBindFramebuffer(GL_FRAMEBUFFER, frame);
    gl_.glGenRenderbuffers(2, buffers);
    gl_.glBindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
    gl_.glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, side_, side_);
    gl_.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    gl_.glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
    gl_.glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, side_, side_);
    gl_.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    if (gl_.glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw WorkError("cannot draw: OpenGL gives no framebuffer with a stencil");
  }

  void paint_with(Color c) {
    gl_.glUniform4f(color_, static_cast<float>(c.r * c.a), static_cast<float>(c.g * c.a),
                    static_cast<float>(c.b * c.a), static_cast<float>(c.a));
  }

  void tile(const Compiler& page, int x, int y, Color background) {
    const Rect here{double(x) * samples_, double(y) * samples_, double(x) * samples_ + side_,
                    double(y) * samples_ + side_};
    gl_.glUniform2f(origin_, static_cast<float>(here.left), static_cast<float>(here.top));
    gl_.glUniform2f(scale_, 2.0f / static_cast<float>(side_), 2.0f / static_cast<float>(side_));
    gl_.glScissor(0, 0, side_, side_);
    gl_.glClearColor(static_cast<float>(background.r * background.a),
                     static_cast<float>(background.g * background.a),
                     static_cast<float>(background.b * background.a), static_cast<float>(background.a));
    gl_.glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    for (const auto& op : page.operations) {
      Rect box = op.clip ? Rect{std::max(here.left, op.clip->left), std::max(here.top, op.clip->top),
                                std::min(here.right, op.clip->right), std::min(here.bottom, op.clip->bottom)}
                         : here;
      if (box.left >= box.right || box.top >= box.bottom) continue;
      if (op.kind != Operation::Kind::dots && !box.overlaps(op.box.grown(1))) continue;
      gl_.glScissor(static_cast<GLint>(box.left - here.left), static_cast<GLint>(box.top - here.top),
                    static_cast<GLsizei>(box.width()), static_cast<GLsizei>(box.height()));
      paint_with(op.color);
      if (op.kind == Operation::Kind::dots)
        dots(op, box);
      else
        stencil_then_cover(op);
    }
  }

  void corners(GLuint buffer) {
    gl_.glBindBuffer(GL_ARRAY_BUFFER, buffer);
    gl_.glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  }

  void stencil_then_cover(const Operation& op) {
    gl_.glDisableVertexAttribArray(1);
    gl_.glVertexAttrib2f(1, 0, 0);
    gl_.glEnable(GL_STENCIL_TEST);
    gl_.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl_.glStencilFunc(GL_ALWAYS, 1, 0xff);
    corners(triangles_);
    const bool winding = op.kind == Operation::Kind::winding;
    gl_.glStencilOp(GL_KEEP, GL_KEEP, winding ? GL_INCR_WRAP : GL_REPLACE);
    if (op.clockwise) gl_.glDrawArrays(GL_TRIANGLES, op.first, op.clockwise);
    gl_.glStencilOp(GL_KEEP, GL_KEEP, winding ? GL_DECR_WRAP : GL_REPLACE);
    if (op.clockwise < op.count)
      gl_.glDrawArrays(GL_TRIANGLES, op.first + op.clockwise, op.count - op.clockwise);

    gl_.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_.glStencilFunc(GL_NOTEQUAL, 0, 0xff);
    gl_.glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);  // leaves the stencil clean for the next path
    const Rect r = op.box.grown(1);
    const auto f = [](double v) { return static_cast<float>(v); };
    const float quad[] = {f(r.left), f(r.top),    f(r.right), f(r.top),
                          f(r.left), f(r.bottom), f(r.right), f(r.bottom)};
    corners(cover_);
    gl_.glBufferData(GL_ARRAY_BUFFER, sizeof quad, quad, GL_STREAM_DRAW);
    gl_.glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_.glDisable(GL_STENCIL_TEST);
  }

  void dots(const Operation& op, const Rect& box) {
    std::vector<float> inside;
    for (Point p : op.places)
      if (p.x() + op.box.right >= box.left && p.x() + op.box.left <= box.right &&
          p.y() + op.box.bottom >= box.top && p.y() + op.box.top <= box.bottom)
        inside.push_back(static_cast<float>(p.x())), inside.push_back(static_cast<float>(p.y()));
    if (inside.empty()) return;
    corners(triangles_);
    gl_.glBindBuffer(GL_ARRAY_BUFFER, places_);
    gl_.glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(inside.size() * sizeof(float)), inside.data(),
                     GL_STREAM_DRAW);
    gl_.glEnableVertexAttribArray(1);
    gl_.glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_.glVertexAttribDivisor(1, 1);
    gl_.glDrawArraysInstanced(GL_TRIANGLES, op.first, op.count, static_cast<GLsizei>(inside.size() / 2));
    gl_.glVertexAttribDivisor(1, 0);
  }

  void average(const std::vector<std::uint8_t>& samples, image::Image& picture, int x0, int y0) const {
    const int n = samples_, area = n * n;
    const auto row_bytes = static_cast<std::size_t>(side_) * 4;
    for (int y = 0; y < std::min(tile_pixels, picture.height - y0); ++y)
      for (int x = 0; x < std::min(tile_pixels, picture.width - x0); ++x) {
        unsigned sum[4] = {};
        for (int j = 0; j < n; ++j) {
          const auto* p = samples.data() + static_cast<std::size_t>(y * n + j) * row_bytes +
                          static_cast<std::size_t>(x * n) * 4;
          for (int i = 0; i < n; ++i, p += 4)
            for (int c = 0; c < 4; ++c) sum[c] += p[c];
        }
        auto* out = picture.pixel(x0 + x, y0 + y);
        const unsigned alpha = sum[3];
        out[3] = static_cast<std::uint8_t>((alpha + static_cast<unsigned>(area) / 2) /
                                           static_cast<unsigned>(area));
        for (int c = 0; c < 3; ++c)  // back to straight alpha
          out[c] = alpha ? static_cast<std::uint8_t>(std::min(255u, (sum[c] * 255u + alpha / 2) / alpha)) : 0;
      }
  }
};

}  // namespace

std::string drawing_versions() {
  const gl::KeepCurrent before;
  const gl::Context context(16, 16, 0);
  return gl::Context::version() + "; " + Fonts::versions();
}

image::Image rasterise(const DisplayList& list, double dpi) {
  const int width = static_cast<int>(std::lround(list.width * dpi / 72));
  const int height = static_cast<int>(std::lround(list.height * dpi / 72));
  if (width < 1 || height < 1 || width > 32768 || height > 32768)
    throw InputError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels is not allowed, at most 32768 each");
  const int samples = samples_for(dpi);
  Compiler page(dpi / 72 * samples);
  page.add(list);
  return Raster(samples).draw(page, width, height, list.background);
}

}  // namespace chute::plot
