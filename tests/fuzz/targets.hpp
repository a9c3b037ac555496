#pragma once
#include <array>
#include <string_view>

/// The readers of files that other people write, each as a function of bytes. What users are told (InputError, WorkError) is a
/// good end; whatever else comes out is a fault.
namespace chute::fuzz {

void scene(
    std::string_view bytes);  ///< a scene file, checked as `chute check` does and written as TOML again
void recipe(
    std::string_view bytes);         ///< a figure's recipe, drawn with a small table as far as a display list
void table(std::string_view bytes);  ///< a CSV file with the summaries of its columns
void frame(std::string_view bytes);  ///< a VTK file: grains, lines, walls
void grid(std::string_view bytes);   ///< VTK image data
void checkpoint(std::string_view bytes);  ///< a checkpoint file, and its state as if its checksum were right
void picture(std::string_view bytes);     ///< a PNG file: its pixels and its text

struct Target {
  std::string_view name;
  void (*read)(std::string_view bytes);
};
inline constexpr std::array<Target, 7> targets{{{"scene", scene},
                                                {"recipe", recipe},
                                                {"table", table},
                                                {"frame", frame},
                                                {"grid", grid},
                                                {"checkpoint", checkpoint},
                                                {"picture", picture}}};

}  // namespace chute::fuzz
