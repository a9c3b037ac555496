#include "engines/contact/solver/anderson.hpp"

#include <Eigen/Cholesky>

namespace chute::contact {

Anderson::Anderson(Eigen::VectorXd weights, int memory)
    : weights_(std::move(weights)),
      step_changes_(weights_.size(), memory),
      image_changes_(weights_.size(), memory),
      products_(memory, memory) {}

bool Anderson::mix(Eigen::VectorXd& image, const Eigen::VectorXd& step) {
  // Steps that hardly differ leave the combination undetermined: this much, of the mean diagonal, keeps it
  // small. It bounds what rounding may do and is far below what decides.
  constexpr double regularisation = 1e-10;
  const Eigen::VectorXd weighted = step.cwiseProduct(weights_);
  if (!fresh_) {
    step_changes_.col(newest_) = weighted - last_step_;
    image_changes_.col(newest_) = image - last_image_;
    kept_ = std::max(kept_, newest_ + 1);
    for (Eigen::Index k = 0; k < kept_; ++k)
      products_(k, newest_) = products_(newest_, k) = step_changes_.col(k).dot(step_changes_.col(newest_));
    newest_ = (newest_ + 1) % step_changes_.cols();
  }
  fresh_ = false;
  last_step_ = weighted;
  last_image_ = image;
  if (kept_ == 0) return false;
  Eigen::MatrixXd normal = products_.topLeftCorner(kept_, kept_);
  normal.diagonal().array() += regularisation * normal.trace() / static_cast<double>(kept_);
  const Eigen::VectorXd weight = normal.ldlt().solve(step_changes_.leftCols(kept_).transpose() * weighted);
  if (!weight.allFinite()) {
    forget();
    return false;
  }
  image.noalias() -= image_changes_.leftCols(kept_) * weight;
  return true;
}

}  // namespace chute::contact
