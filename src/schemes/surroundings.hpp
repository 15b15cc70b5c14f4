#pragma once
#include <vector>

#include "schemes/gradient_correction.hpp"
#include "schemes/half_space.hpp"

namespace ejecta {

/// What a first pass over the pairs tells of the surroundings of every particle; needed only with stress.
template <int Dim>
struct Surroundings {
  struct Sums {
    Mat<Dim> moment = Mat<Dim>::Zero();   ///< M of the own neighbours
    Mat<Dim> contact = Mat<Dim>::Zero();  ///< what other pieces add to it
    double least = least_moment;          ///< smallest stretch of M that is inverted as it stands
    double least_of_all = least_moment;   ///< the same with what other pieces add
    Vec<Dim> outward = Vec<Dim>::Zero();  ///< sum over other pieces of V_j grad W, in 1/length_unit
    double occupied = 0;                  ///< sum over other pieces of V_j W
    /// Towards what it is in contact with; 0 if nothing is.
    Vec<Dim> normal() const { return occupied > 0 ? Vec<Dim>(outward.normalized()) : Vec<Dim>(Vec<Dim>::Zero()); }
  };
  std::vector<Sums> sums;
  std::vector<Mat<Dim>> cut;  ///< the share of M that cracks cut off; empty where none can
  bool corrects = false;      ///< gradients are corrected by M
  /// `occupied` of a particle half its own size from another piece, at u = size/(2 h).
  HalfSpace half_space;

  /// By the own neighbours, and by all.
  GradientCorrection<Dim> own(const Sums& s) const {
    return corrects ? gradient_correction<Dim>(s.moment, s.least) : GradientCorrection<Dim>{};
  }
  GradientCorrection<Dim> all(const Sums& s) const {
    return corrects ? gradient_correction<Dim>(s.moment + s.contact, s.least_of_all) : GradientCorrection<Dim>{};
  }
  /// By the own neighbours on this side of all cracks.
  GradientCorrection<Dim> uncut(std::size_t i) const {
    return cut.empty() || cut[i].isZero(0) ? own(sums[i])
                                           : gradient_correction<Dim>(sums[i].moment - cut[i], sums[i].least);
  }
};

}  // namespace ejecta
