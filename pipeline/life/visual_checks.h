// Visual checks of wear.
//
// Wear is visible for W hours of motion before the failure. Checks are tau hours of motion apart, with a random phase. Each check
// finds visible wear with the probability p, independently of the others. W contains n = floor(W / tau) checks, and one more with
// the probability W / tau - n:
//     found before = 1 - (1 - p)^n [1 - p (W / tau - n)]                                                    (F32)
#pragma once

namespace dresslife::pipeline {

/// Returns (F32). visible: W, interval: tau [h], > 0; found: p.
double found_before(double visible, double interval, double found);

}  // namespace dresslife::pipeline
