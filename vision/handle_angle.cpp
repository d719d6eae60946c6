#include "vision/handle_angle.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vision/fit/grip_evidence.hpp"

namespace hogline::vision {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float blur_px = 0.65F;
constexpr float wall_light = 0.65F;  // of what stands upright, as a share of what lies level
constexpr float wall_light_sigma = 0.2F;
constexpr int directions = 24;  // tried at first, all around: the neck tells the ends apart
constexpr int most_steps = 3;
constexpr float raised_sigma_m = 0.008F;  // what makers leave open
constexpr float longer_sigma_m = 0.010F;
constexpr float correlated = 3.0F;  // neighbouring pixels share their noise
constexpr float edge_px = 0.15F;    // what the pixels of an edge have in common
constexpr double fewest_pixels = 24.0;
constexpr double least_visible = 0.6;
constexpr double least_explained = 0.35;
constexpr double well_explained = 0.7;
constexpr double one_of_many_factor = 2.0;  // on the sigma of what is not believed by itself
constexpr double most_lumpy = 7.0;          // of the misfit: noise makes about two
constexpr double most_sigma_rad = 0.35;
constexpr float another_rad = 0.35F;     // from here on it is another direction,
constexpr float as_good_sigmas2 = 9.0F;  // and this much worse than the best may be as good

using Numbers = Eigen::Vector3f;  ///< turn, raised, longer

const Numbers probe(0.06F, 0.003F, 0.004F);
const Numbers longest(0.2F, 0.008F, 0.008F);

float half_turn(float angle) { return angle - pi * std::round(angle / pi); }

/// A stance refined, with its misfit's slope and curvature there.
struct Refined {
  Numbers at;
  float cost = 0.0F;
  Numbers slope = Numbers::Zero();
  Eigen::Matrix3f curvature = Eigen::Matrix3f::Zero();
};

class Search {
 public:
  explicit Search(const GripEvidence& evidence) : evidence_(evidence) {}

  /// A direction that a step or two may make as good as the best.
  bool is_close(const Refined& best, float turn_rad) {
    return turn_rad != best.at[0] && misfit({turn_rad, 0.0F, 0.0F}) < 0.5F * (best.cost + evidence_.misfit_of_none());
  }

  /// The best directions of all tried, and another that is better than those beside it.
  std::array<float, 2> rough() {
    std::array<float, directions> misfits{};
    for (std::size_t i = 0; i < directions; ++i) {
      misfits[i] = misfit({turn_of(i), 0.0F, 0.0F});
      present_[i] = evidence_.presence(cover_, wall_light_);
    }
    const auto best = static_cast<std::size_t>(std::min_element(misfits.begin(), misfits.end()) - misfits.begin());
    std::size_t second = best;
    for (std::size_t i = 0; i < directions; ++i) {
      const bool dip = misfits[i] < misfits[(i + 1) % directions] &&
                       misfits[i] < misfits[(i + directions - 1) % directions] && i != best;
      if (dip && (second == best || misfits[i] < misfits[second])) second = i;
    }
    settle_walls(turn_of(best), misfits[best] / static_cast<float>(evidence_.used));
    pixel_variance_ = misfits[best] / static_cast<float>(evidence_.used);
    return {turn_of(best), turn_of(second)};
  }

  double lumpiness(const Refined& best) {
    misfit(best.at);
    return evidence_.lumpiness(cover_, wall_light_);
  }

  /// The most of a grip that may be there in any direction tried by rough(), two sigmas granted.
  double most_present() const {
    float most = 0.0F;
    for (const auto& seen : present_) {
      most = std::max(most, seen.share + 2.0F * seen.sigma * std::sqrt(correlated * pixel_variance_));
    }
    return double{most};
  }

  Refined refine(float turn_rad) {
    Refined r{{turn_rad, 0.0F, 0.0F}};
    r.cost = cost(r.at);
    for (int i = 0; i < most_steps; ++i) {
      expand(r);
      if (!advance(r)) break;
    }
    expand(r);
    correlate(r);
    return r;
  }

 private:
  static float turn_of(std::size_t i) { return 2.0F * pi * static_cast<float>(i) / directions; }

  void settle_walls(float turn_rad, float variance) {
    misfit({turn_rad, 0.0F, 0.0F});
    wall_light_ = evidence_.wall_light(cover_, wall_light, wall_light_sigma, correlated * variance);
  }

  float misfit(const Numbers& at) {
    GripStance stance;
    stance.turn_rad = at[0];
    stance.raised_m = at[1];
    stance.longer_m = at[2];
    cover_by_grip(evidence_.sights, shape_, stance, blur_px, cover_);
    return evidence_.misfit(cover_, wall_light_);
  }

  float cost(const Numbers& at) {
    const float raised = at[1] / raised_sigma_m;
    const float longer = at[2] / longer_sigma_m;
    return misfit(at) + pixel_variance_ * (raised * raised + longer * longer);
  }

  void expand(Refined& r) {
    for (int i = 0; i < 3; ++i) {
      const Numbers step = probe[i] * Numbers::Unit(i);
      const float up = cost(r.at + step);
      const float down = cost(r.at - step);
      r.slope[i] = 0.5F * (up - down) / probe[i];
      r.curvature(i, i) = (up + down - 2.0F * r.cost) / (probe[i] * probe[i]);
    }
  }

  // The curvature off its diagonal.
  void correlate(Refined& r) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < i; ++j) {
        const float both = cost(r.at + probe[i] * Numbers::Unit(i) + probe[j] * Numbers::Unit(j));
        const float one = r.slope[i] * probe[i] + 0.5F * r.curvature(i, i) * probe[i] * probe[i];
        const float other = r.slope[j] * probe[j] + 0.5F * r.curvature(j, j) * probe[j] * probe[j];
        r.curvature(i, j) = r.curvature(j, i) = (both - r.cost - one - other) / (probe[i] * probe[j]);
      }
    }
  }

  /// False where nothing better is found.
  bool advance(Refined& r) {
    Numbers step = -r.slope.cwiseQuotient(r.curvature.diagonal().cwiseAbs().cwiseMax(1e-6F));
    step = step.cwiseMin(longest).cwiseMax(-longest);
    for (const float part : {1.0F, 0.4F}) {
      const float better = cost(r.at + part * step);
      if (!(better < r.cost)) continue;
      r.at += part * step;
      r.cost = better;
      return true;
    }
    return false;
  }

  const GripEvidence& evidence_;
  GripShape shape_;
  GripCover cover_;
  std::array<GripEvidence::Presence, directions> present_;
  float pixel_variance_ = 0.0F;
  float wall_light_ = wall_light;
};

float noise_of(const Refined& best, const GripEvidence& evidence) {
  return correlated * best.cost / static_cast<float>(evidence.used);
}

// What the noise leaves open, and what the pixels of an edge have in common, at the bar's ends.
double sigma_of(const Refined& found, const GripEvidence& evidence) {
  const Eigen::LLT<Eigen::Matrix3f> solver(found.curvature);
  const Numbers turn = Numbers::UnitX();
  const float per_noise =
      solver.info() == Eigen::Success ? solver.solve(turn)[0] : 1.0F / std::max(0.0F, found.curvature(0, 0));
  const Eigen::Vector2f across(-std::cos(found.at[0]), -std::sin(found.at[0]));
  const Eigen::Vector2f end_px = evidence.sights.by_pixel.inverse() * across;
  const double px_per_rad = GripShape().half_length_m * double{end_px.norm()};
  return std::hypot(std::sqrt(double{2.0F * noise_of(found, evidence) * per_noise}), double{edge_px} / px_per_rad);
}

bool contradict(const Refined& best, const Refined& other, const GripEvidence& evidence) {
  const bool as_good = other.cost - best.cost < as_good_sigmas2 * noise_of(best, evidence);
  return as_good && std::abs(half_turn(other.at[0] - best.at[0])) > another_rad;
}

}  // namespace

HandleAngle handle_angle(const StonePicture& picture, const StoneSighting& stone,
                         const std::vector<Eigen::Vector2d>& others) {
  HandleAngle angle;
  const Light handle = Eigen::Vector3f(stone.colour[2], stone.colour[1], stone.colour[0]).cast<double>();
  const GripEvidence evidence = grip_evidence(picture, GripShape(), {stone.x_m, stone.y_m}, handle, others);
  angle.visible = evidence.visible;
  if (evidence.used < fewest_pixels || evidence.visible < least_visible) {
    angle.reason = "too little of it can be seen";
    return angle;
  }

  Search search(evidence);
  const std::array<float, 2> rough = search.rough();
  angle.present = search.most_present();
  Refined best = search.refine(rough[0]);
  Refined other = search.is_close(best, rough[1]) ? search.refine(rough[1]) : best;
  if (other.cost < best.cost) std::swap(best, other);

  const float bare = evidence.misfit_of_none();
  angle.explained = bare > 0.0F ? std::max(0.0, 1.0 - double{best.cost / bare}) : 0.0;
  angle.rad = double{half_turn(best.at[0])};
  angle.sigma_rad = sigma_of(best, evidence);
  if (angle.explained < least_explained) {
    angle.reason = "no grip explains what is seen over the plate";
  } else if (search.lumpiness(best) > most_lumpy) {
    angle.reason = "something else is seen over the plate";
    angle.one_of_many = angle.explained >= well_explained && angle.sigma_rad < most_sigma_rad;
  } else if (contradict(best, other, evidence)) {
    angle.reason = "two directions explain it equally well";
  } else if (!(angle.sigma_rad < most_sigma_rad)) {
    angle.reason = "its direction is hardly seen";
  }
  angle.ok = angle.reason.empty();
  return angle;
}

void measure_handle(const StonePicture& picture, const std::vector<Eigen::Vector2d>& places, StoneSighting& stone) {
  const HandleAngle handle = handle_angle(picture, stone, places);
  if (!handle.ok) return;
  stone.handle_rad = handle.rad;
  stone.handle_sigma_rad = handle.sigma_rad;
}

void measure_turning_handle(const StonePicture& picture, const std::vector<Eigen::Vector2d>& places,
                            StoneSighting& stone) {
  const HandleAngle handle = handle_angle(picture, stone, places);
  if (!handle.ok && !handle.one_of_many) return;
  stone.handle_rad = handle.rad;
  stone.handle_sigma_rad = (handle.ok ? 1.0 : one_of_many_factor) * handle.sigma_rad;
}

}  // namespace hogline::vision
