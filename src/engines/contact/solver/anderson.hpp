#pragma once
#include <Eigen/Core>
#include <span>

namespace chute::contact {

/// Anderson's mixing (1965) for a fixed point x = G(x): from the last few images g = G(x) and steps f = g − x the
/// combination of images whose step would be least if G were linear. On a linear G it is GMRES with G as the
/// preconditioner, so that a sweep which only damps long waves slowly converges in far fewer.
class Anderson {
 public:
  /// `weights`, one per component: the steps are measured by √Σ(weight f)².
  Anderson(Eigen::VectorXd weights, int memory);

  /// Takes an image and its step. Where there is a history, replaces the image by the combination and says so.
  bool mix(Eigen::VectorXd& image, const Eigen::VectorXd& step);
  void forget() { kept_ = newest_ = 0, fresh_ = true; }

 private:
  Eigen::VectorXd weights_, last_step_, last_image_;
  Eigen::MatrixXd step_changes_, image_changes_, products_;
  Eigen::Index kept_ = 0, newest_ = 0;
  bool fresh_ = true;
};

}  // namespace chute::contact
