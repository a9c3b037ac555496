#include "harness.hpp"
#include "tool.hpp"

/// Draws golden pictures anew, when a change of theirs is wanted. Never run by a test.
int main(int argc, char** argv) {
  using namespace chute;
  CLI::App app{"Draw golden pictures anew and record why. Look at every one of them before you commit it."};
  std::vector<std::string> names;
  std::string reason, folder = std::string(CHUTE_SOURCE_DIR) + "/golden";
  app.add_option("names", names, "goldens by name")->required();
  app.add_option("--reason", reason, "why the pictures change; goes to manifest.json")->required();
  app.add_option("--folder", folder, "where they are")->capture_default_str();
  app.footer("Example: update_goldens --reason \"legend moved inside\" log-axes band");
  return golden::run_tool(app, argc, argv, [&] {
    for (const auto& line : golden::update(folder, golden::all_goldens(), names, reason))
      fmt::print("{}\n", line);
  });
}
