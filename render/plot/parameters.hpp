#pragma once
#include <string>
#include <vector>

/// What a figure's table says about how it is to be shown, in its comments:
///
///     # parameters a: Phi=2.5 sin(theta)=0.057     what was held fixed in panel a; without a panel, in all
///     # hollow a: e_n=0.8                          this series is averaged over runs that had not settled
namespace chute::plot {

/// The parameters of a panel as text for its heading, those of all panels first; empty if the comments tell none.
std::string parameters_of(const std::vector<std::string>& comments, const std::string& panel);

/// Is this series of the panel to be drawn hollow?
bool is_told_hollow(const std::vector<std::string>& comments, const std::string& panel,
                    const std::string& series);

}  // namespace chute::plot
