#pragma once
#include <cstddef>
#include <functional>
#include <string>

#include "image/image.hpp"

namespace chute::view {

/// Draws picture `number` into `into`; true if it had to be drawn, false if it was there. With `wanted` false
/// only its file matters, and `into` may stay as it is.
using Draw = std::function<bool(std::size_t number, bool wanted, image::Image& into)>;
/// Takes the pictures in order of their numbers; the picture is empty if pixels are not wanted.
using Take = std::function<void(std::size_t number, bool drawn, const image::Image& picture)>;

/// Draws pictures 0 … count - 1, `jobs` at once, each job a process of its own (VTK's drawing is not made for
/// threads), and hands them over one after the other. `make_draw` is called once in each process. What a
/// process throws is thrown here. A process that has several threads, as it has once it has drawn something
/// itself, cannot be forked: then it draws all pictures by itself.
void draw_all(std::size_t count, int jobs, int width, int height, bool wanted,
              const std::function<Draw()>& make_draw, const Take& take);

}  // namespace chute::view
