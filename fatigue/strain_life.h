// Life of a wire under one closed cycle: strain-life curves with the effect of mean stress.
//
// With N cycles, 2N reversals, strain amplitude eps_a, largest and mean stress of the cycle s_max and s_m:
//   Coffin-Manson (8):  eps_a = sf/E (2N)^b + ef (2N)^c
//   SWT (9):            s_max eps_a = sf^2/E (2N)^(2b) + sf ef (2N)^(b+c);  s_max <= 0: no damage
//   Morrow (F7):        eps_a = (sf - s_m)/E (2N)^b + ef (2N)^c
//   Walker (F12):       eps_a read on (8) gives 2N*; 2N = 2N* (s_a/s_max)^(-(1-gamma)/b), s_a = s_max - s_m;
//                       s_max <= 0: no damage
// (numbers as in the thesis by S. Backman, 2018; Morrow 1968; Smith, Watson and Topper 1970; Walker 1970 in
// the strain-life form of Dowling 2009). Damage of a cycle: 1/N.
//
// Lives are solved within 1 <= 2N <= `longest`; `longest` is 1e15 by default. A load beyond the curve at 2N = 1 is outside the
// curve's range: the wire breaks on its first reversal, with 2N = 1 and a damage of 2 per cycle for any excess. A life beyond
// `longest` does no damage.
#pragma once

#include <vector>

#include "pipeline/job/fatigue.h"
#include "pipeline/job/material.h"

namespace dresslife::fatigue {

constexpr double fewest_reversals = 1;
constexpr double most_reversals = 1e15;

/// y(x) = A x^p + C x^q, A, C > 0, p, q < 0. It falls from infinity to 0, so each y > 0 has one x.
class PowerSum {
 public:
  PowerSum(double a, double p, double c, double q);
  double operator()(double x) const;
  double slope(double x) const;    ///< dy/dx < 0
  double inverse(double y) const;  ///< precondition: y > 0; x is exact to rounding

 private:
  double a_, p_, c_, q_;
};

/// Strain and stress of one cycle.
struct CycleLoad {
  double strain_amplitude = 0;  ///< eps_a [1]
  double stress_max = 0;        ///< [Pa]
  double stress_mean = 0;       ///< [Pa]
};

/// Lives by (8), (9), (F7) or (F12), exact to rounding. DamageCounter in damage.h computes the same faster.
class StrainLife {
 public:
  /// Amplitudes up to `endurance_strain` do no damage. longest: largest 2N.
  StrainLife(const pipeline::Material& material, pipeline::MeanStress mean_stress, double endurance_strain = 0,
             double longest = most_reversals);

  double reversals(const CycleLoad& load) const;  ///< 2N; infinity if the load does no damage
  double damage(const CycleLoad& load) const;     ///< 1/N of one full cycle; 0 to 2

  const PowerSum& coffin_manson() const { return coffin_manson_; }  ///< (8): eps_a as a function of 2N
  const PowerSum& swt() const { return swt_; }                      ///< (9): s_max eps_a [Pa] as a function of 2N
  pipeline::MeanStress mean_stress() const { return mean_stress_; }
  double endurance_strain() const { return endurance_strain_; }
  double longest() const { return longest_; }

  /// Morrow's curve is (8) with a scaled life axis, so one curve serves every mean stress (F8). With u = 1 - s_m/sf and 2N = k x,
  /// k = u^(1/(c-b)): u sf/E (k x)^b + ef (k x)^c = k^c (sf/E x^b + ef x^c), since u k^b = k^c.
  struct MorrowScale {
    double strain;  ///< k^c: (8) is read at eps_a / strain
    double life;    ///< k: 2N is life times x
  };
  MorrowScale morrow_scale(double stress_mean) const;  ///< precondition: s_m < sf

  /// Returns 2N / 2N* of (F12), which is below 1 for tension. Precondition: s_max > 0.
  double walker_stretch(double stress_max, double stress_mean) const;
  double fatigue_strength() const { return material_.fatigue_strength; }

 private:
  pipeline::Material material_;
  pipeline::MeanStress mean_stress_;
  double endurance_strain_, longest_;
  PowerSum coffin_manson_, swt_;
  double walker_power_;  // -(1-gamma)/b
};

/// Life from measured points (eps_a, N), linear between them in log eps_a and log N (F13). Beyond the first and the last point
/// the end pieces are extended, within the same 1 <= 2N <= longest. For polymers, which (8) does not fit. Mean stress and strain
/// are those of the test; no correction is applied.
class StrainLifeTable {
 public:
  /// Precondition: at least two points, strains falling, cycles rising.
  explicit StrainLifeTable(const std::vector<pipeline::StrainLifePoint>& points, double longest = most_reversals);
  double cycles(double strain_amplitude) const;  ///< N; infinity if the load does no damage
  double damage(double strain_amplitude) const { return 1 / cycles(strain_amplitude); }

 private:
  struct Piece {
    double log_strain, log_cycles, slope;  // at its larger strain; d ln N / d ln eps
  };
  std::vector<Piece> pieces_;
  double longest_;
};

}  // namespace dresslife::fatigue
