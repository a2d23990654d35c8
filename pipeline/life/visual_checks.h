// Visual checks of visible wear.
//
// Wear is visible for W hours of motion before the failure. Checks come every tau hours of motion, the first at any phase, and
// each finds visible wear with the probability p, independently of the others. In W there are n = floor(W / tau) checks, and one
// more with the probability W / tau - n:
//     found before = 1 - (1 - p)^n [1 - p (W / tau - n)]                                                    (F32)
#pragma once

namespace dresslife::pipeline {

/// (F32). visible: W, interval: tau [h], > 0; found: p.
double found_before(double visible, double interval, double found);

}  // namespace dresslife::pipeline
