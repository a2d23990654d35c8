// The peak performance of one core of this machine: the reference for the other figures.
//
// fma_gflops: fused multiply-adds on f32 registers, two operations each, in so many independent chains that their latency is
// hidden. target_clones below compiles it for this machine.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace {

constexpr int lanes = 16, chains = 12;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float))));

#if defined(__x86_64__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
void multiply_add(Lanes* x, long times) {
  Lanes a[chains];
  for (int c = 0; c < chains; ++c) a[c] = x[c];
  const Lanes factor = x[chains], term = x[chains + 1];
  for (long i = 0; i < times; ++i)
    for (int c = 0; c < chains; ++c) a[c] = a[c] * factor + term;
  for (int c = 0; c < chains; ++c) x[c] = a[c];
}

}  // namespace

int main() {
  alignas(64) std::array<Lanes, chains + 2> x{};
  for (int c = 0; c < chains + 2; ++c)
    for (int l = 0; l < lanes; ++l) x[c][l] = 0.5f + 0.001f * static_cast<float>(c + l);
  constexpr long times = 20'000'000;
  double best = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto begin = std::chrono::steady_clock::now();
    multiply_add(x.data(), times);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    best = std::max(best, 2.0 * lanes * chains * times / seconds * 1e-9);
  }
  volatile float keep = x[0][0];
  (void)keep;
  std::printf("fma_gflops %.2f\n", best);
}
