// What a step of the fluid costs, and what the machine could do at most.
//
// step/<scheme>/<kernel and h/dx>/<particles>/<threads>: whole steps as a run makes them (step limit, integration, sort,
// equation of state, walls, pairs) of a block of water between six walls (bench/block.hpp). Counters:
//   updates/s/core   particles times steps, per second of wall time and thread
//   ns/neighbour     wall time times threads per true neighbour (directed; walls among them; a scheme's gradient pass
//                    is not counted again, but its time is in)
//   neighbours       true neighbours per particle
//   bytes/particle   memory that the fluid holds
//   "pairs %", ...   share of each pass in the wall time; what is missing to 100 is the step limit
// The columns Time and CPU are per step, CPU of the main thread: where it is well below Time, something else was running.
//
// machine/fma/<type>/<threads>: multiply-adds in registers (FLOP/s/core), at the pair loops' instruction set.
// machine/triad/<threads>: a = b + s c over arrays far beyond the caches (byte/s in all; 24 an element, as STREAM counts).
// The roofline: FLOP/s/core times ns/neighbour is what the units could have done per neighbour; byte/s times Time over the
// particles is what memory could have moved per particle and step.
//
// The default set takes about three minutes on two cores. Choose by --benchmark_filter=REGEX:
//   fluid_bench --benchmark_filter=machine                       the probe alone
//   fluid_bench --benchmark_filter='riemann/.*/50k/1'            some variants, in a few seconds
//   fluid_bench --benchmark_filter='riemann/wendland_c2_1.5/(50k|200k|1M|4M)/1'  cost against size up to four million
// 4M and 10M (memory: about 0.5 kB a particle; time: minutes each) exist only where the filter has these letters in it.
// --benchmark_repetitions=N, --benchmark_min_time=S and --benchmark_out=FILE (JSON) as in every Google Benchmark. Five
// repetitions by default; look at the medians. UNDEX_CPU_LEVEL lowers the instruction set. On a machine that others use as
// well, OMP_WAIT_POLICY=passive keeps waiting threads from taking part in the contest.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bench/block.hpp"
#include "bench/fma_peak.hpp"
#include "sph_fluid/pairs/cpu_level.hpp"

namespace undex::bench {
namespace {

class StopWatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::map<std::string, double> pass_seconds(const sph::Fluid& fluid) {
  return {fluid.timers().seconds().begin(), fluid.timers().seconds().end()};
}

/// The block of that name, laid out and stepped once; repetitions of one benchmark go on with the same block.
sph::Fluid& prepared(const std::string& name, const sph::Settings& settings) {
  static std::string held;
  static std::unique_ptr<sph::Fluid> fluid;
  if (held != name) {
    fluid.reset();  // two blocks may not fit into memory
    fluid = std::make_unique<sph::Fluid>(settings);
    fluid->step(fluid->step_limit().step);
    held = name;
  }
  return *fluid;
}

void step(benchmark::State& state, const std::string& name, const sph::Settings& settings) {
  sph::Fluid& fluid = prepared(name, settings);
  const double particles = double(fluid.particle_count());
  const auto passes = pass_seconds(fluid);
  const long long interactions = fluid.neighbour_interactions();
  const StopWatch watch;
  for (auto _ : state) fluid.step(fluid.step_limit().step);
  const double wall = watch.seconds(), core_seconds = wall * settings.numerics.threads;
  const double updates = particles * double(state.iterations());
  const double neighbours = double(fluid.neighbour_interactions() - interactions);
  state.counters["updates/s/core"] = updates / core_seconds;
  state.counters["ns/neighbour"] = 1e9 * core_seconds / neighbours;
  state.counters["neighbours"] = neighbours / updates;
  state.counters["bytes/particle"] = double(fluid.memory_bytes()) / particles;
  for (const auto& [pass, seconds] : pass_seconds(fluid)) {
    const auto before = passes.find(pass);
    const double spent = seconds - (before == passes.end() ? 0.0 : before->second);
    if (spent > 0) state.counters[pass + " %"] = 100.0 * spent / wall;
  }
}

void fma(benchmark::State& state, FmaChains chains, int threads) {
  double operations = 0;
  const StopWatch watch;
  for (auto _ : state) {
#pragma omp parallel num_threads(threads) reduction(+ : operations)
    operations += chains(10'000'000);
  }
  state.counters["FLOP/s/core"] = operations / watch.seconds() / threads;
}

void triad(benchmark::State& state, int threads) {
  constexpr long n = 1L << 24;  // 3 x 128 MiB
  // Each thread touches first what it will use.
  const auto array = [&](double value) {
    std::unique_ptr<double[]> a(new double[n]);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (long i = 0; i < n; ++i) a[i] = value;
    return a;
  };
  const auto a = array(0.0), b = array(1.0), c = array(2.0);
  const StopWatch watch;
  for (auto _ : state) {
    double* const to = a.get();
    const double *const left = b.get(), *const right = c.get();
#pragma omp parallel for simd num_threads(threads) schedule(static)
    for (long i = 0; i < n; ++i) to[i] = left[i] + 3.0 * right[i];
    benchmark::ClobberMemory();
  }
  state.counters["byte/s"] = 24.0 * double(n) * double(state.iterations()) / watch.seconds();
}

/// 1, 2, 4, ... as far as the machine goes.
std::vector<int> thread_counts() {
  std::vector<int> counts;
  for (unsigned n = 1; n <= std::max(1u, std::thread::hardware_concurrency()); n *= 2) counts.push_back(int(n));
  return counts;
}

void register_all(const std::string& filter) {
  struct Size {
    const char* name;
    double particles;
    bool by_name_only, scaling;
  };
  const Size sizes[] = {{"50k", 50e3, false, false},
                        {"200k", 200e3, false, true},
                        {"1M", 1e6, false, false},
                        {"4M", 4e6, true, false},
                        {"10M", 10e6, true, false}};
  const auto add = [](const std::string& name, auto function) {
    benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMillisecond);
  };
  const std::vector<int> threads = thread_counts();
  for (const int n : threads) {
    const std::string end = "/" + std::to_string(n);
    add("machine/fma/double" + end, [=](benchmark::State& state) { fma(state, fma_chains_double(), n); });
    add("machine/fma/float" + end, [=](benchmark::State& state) { fma(state, fma_chains_float(), n); });
    add("machine/triad" + end, [=](benchmark::State& state) { triad(state, n); });
  }
  for (const Size& size : sizes) {
    if (size.by_name_only && filter.find(size.name) == std::string::npos) continue;
    for (const Variant& variant : variants())
      for (const int n : size.scaling ? threads : std::vector<int>{1}) {
        const std::string name = "step/" + variant.name + "/" + size.name + "/" + std::to_string(n);
        const double particles = size.particles;
        add(name, [=](benchmark::State& state) { step(state, name, block(variant, particles, n)); });
      }
  }
}

}  // namespace
}  // namespace undex::bench

int main(int argc, char** argv) {
  // Defaults first: what the user says comes later and wins.
  std::vector<std::string> defaults = {"--benchmark_repetitions=5", "--benchmark_report_aggregates_only=true",
                                       "--benchmark_min_time=0.3", "--benchmark_counters_tabular=true"};
  std::vector<char*> arguments = {argv[0]};
  for (std::string& option : defaults) arguments.push_back(option.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = int(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  benchmark::AddCustomContext("cpu_level", undex::sph::cpu_level());
  undex::bench::register_all(benchmark::GetBenchmarkFilter());
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
