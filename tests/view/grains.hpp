#pragma once
#include <filesystem>

#include "image/image.hpp"
#include "read/grain_frame.hpp"
#include "view/frame_renderer.hpp"

/// Grains made by hand, and pictures of them.
namespace grains {

/// One disc of radius 1 at the origin with speed 2 to the right, in reduced units.
chute::read::GrainFrame one_disc();
/// Adds a grain; `velocity` along x.
void add(chute::read::GrainFrame& frame, double x, double y, double z, double radius, double velocity = 0,
         double angle = 0, int type = 1);
/// A bed of ten discs and two layers over it, periodic with 10, on an incline of 20 degrees.
chute::read::GrainFrame small_chute();
/// A box of n x n x n spheres over a bed.
chute::read::GrainFrame cube(int n);

/// Survey and drawing of a single frame.
chute::image::Image picture(const chute::read::GrainFrame& frame, const chute::view::FrameStyle& style);

/// A style without furniture that shows -2 … 2 in both directions on `side` pixels.
chute::view::FrameStyle bare(int side);

/// Writes a frame as chute does: legacy VTK is enough for the readers.
void write(const chute::read::GrainFrame& frame, const std::filesystem::path& path);

}  // namespace grains
