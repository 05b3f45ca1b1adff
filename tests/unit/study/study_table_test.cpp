// The tables of a study: curves, fronts within a problem, CSV; and what it notes of a run.
#include "study/study_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "study/study_outcome.hpp"
#include "output/text_table.hpp"
#include "tests/unit/output/temporary_folder.hpp"

namespace undex::study {
namespace {

using namespace output;

const double nan = std::nan("");

StudyRow row(const std::string& problem, const std::string& scheme, double h, double cpu, double error) {
  StudyRow r;
  r.name = problem + "__" + scheme + "__" + print("%g", h);
  r.values = {problem, scheme, print("%g", h)};
  r.curve = problem + ", " + scheme;
  r.problem = problem;
  r.h = h;
  r.status = "done";
  r.record.steps = 10;
  r.record.particles = 100;
  r.record.solver_memory_bytes = 25000;
  r.record.energy_error = -1e-3;
  r.cpu_times = {cpu + 1, cpu};
  r.wall_times = {cpu + 1, cpu};
  r.errors = {error};
  return r;
}

/// Two problems; in the first the dear scheme is of second order, the cheap one of first, and one run was stopped.
StudyTable table() {
  StudyTable t{"a title", {"scene", "scheme", "spacing"}, "spacing", {"l1"}, {}};
  for (const double h : {0.1, 0.4, 0.2}) {  // not in order
    t.rows.push_back(row("tube", "good", h, 1 / h, h * h));
    t.rows.push_back(row("tube", "cheap", h, 0.2 / h, h));
  }
  t.rows.push_back(row("tube", "cheap", 0.05, 4, nan));
  t.rows.back().status = "stopped";
  t.rows.back().message = "energy, off by \"half\"";
  t.rows.push_back(row("slab", "cheap", 0.1, 100, 50));
  t.rows.push_back(row("slab", "cheap", 0.2, 10, 100));
  return t;
}

TEST(StudyTable, OrdersAlongEachCurve) {
  const std::vector<ObservedOrders> orders = observed_orders(table());
  ASSERT_EQ(orders.size(), 3u);
  EXPECT_EQ(orders[0].curve, "tube, good");
  EXPECT_EQ(orders[0].h, (std::vector<double>{0.4, 0.2, 0.1})) << "from coarse to fine";
  for (const double p : orders[0].between) EXPECT_NEAR(p, 2, 1e-12);
  EXPECT_NEAR(orders[0].fitted, 2, 1e-12);
  EXPECT_EQ(orders[1].curve, "tube, cheap");
  EXPECT_EQ(orders[1].h.size(), 3u) << "the stopped run is no point";
  EXPECT_NEAR(orders[1].fitted, 1, 1e-12);
  EXPECT_NEAR(orders[2].fitted, 1, 1e-12);
  EXPECT_EQ(order_csv({orders[2]}),
            "error,curve,kind,coarse,fine,error coarse,error fine,order\n"
            "l1,\"slab, cheap\",between,0.2,0.1,100,50,1\n"
            "l1,\"slab, cheap\",least squares,0.2,0.1,100,50,1\n");
  EXPECT_NE(order_text(orders).find("0.4 to 0.2   0.2 to 0.1   least squares"), std::string::npos) << order_text(orders);
  StudyTable without = table();
  without.resolution = "";
  EXPECT_TRUE(observed_orders(without).empty());
}

TEST(StudyTable, FrontsKeepToTheirProblem) {
  // Errors and least times: good 0.01/10, 0.16/2.5, 0.04/5; cheap 0.1/2, 0.4/0.5, 0.2/1; beaten is good at 0.4.
  const std::vector<std::vector<bool>> fronts = pareto_fronts(table());
  EXPECT_EQ(fronts[0], (std::vector<bool>{true, true, false, true, true, true, false, true, true}));
}

TEST(StudyTable, CsvHasARowARun) {
  const std::string text = study_csv(table());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_NE(text.find("run,scene,scheme,spacing,curve,problem,status,message,error: l1,pareto: l1,cpu_time_s,"),
            std::string::npos);
  EXPECT_NE(text.find("\ntube__good__0.1,tube,good,0.1,\"tube, good\",tube,done,,0.01,1,10,11,10,2,"), std::string::npos) << text;
  EXPECT_NE(text.find(",stopped,\"energy, off by \"\"half\"\"\",,,4,5,"), std::string::npos) << "no error, on no front\n" << text;
  EXPECT_NE(text.find(",25000,250,"), std::string::npos) << "bytes a particle";
}

TEST(StudyTable, TextLeavesOutWhatIsNotThere) {
  StudyTable t = table();
  t.rows.push_back({});
  t.rows.back().status = "not run";
  t.rows.back().errors = {nan};
  const std::string text = study_text(t);
  EXPECT_NE(text.find("1 more not run yet\n"), std::string::npos);
  EXPECT_NE(text.find("1.000e-02*"), std::string::npos) << text;
  EXPECT_EQ(text.find("1.600e-01*"), std::string::npos) << text;
  EXPECT_EQ(study_csv(t).find("not run") == std::string::npos, false) << "the CSV has it";
}

TEST(StudyTable, OutcomeIsReadBack) {
  const TemporaryFolder folder;
  const auto path = folder.path / "outcome.json";
  EXPECT_FALSE(read_outcome(path).has_value());
  write_outcome(path, {"limit", "ended at cpu_limit = 3 s", {3.1, 2.9}, {4}, 3, 0});
  const auto outcome = read_outcome(path);
  ASSERT_TRUE(outcome.has_value());
  EXPECT_EQ(outcome->status, "limit");
  EXPECT_EQ(outcome->cpu_times_s, (std::vector<double>{3.1, 2.9}));
  EXPECT_EQ(outcome->cpu_limit_s, 3);
  for (const char* damaged : {"", "{", "[]", "{\"status\": 3}"}) {
    std::ofstream(path) << damaged;
    EXPECT_FALSE(read_outcome(path).has_value()) << damaged;
  }
}

TEST(TextTable, AlignedCellsAndDurations) {
  EXPECT_EQ(aligned({{"run", "status", "CPU s"}, {"µ", "done", "1"}, {"longer"}}, 2),
            "run      status   CPU s\nµ        done         1\nlonger\n");
  EXPECT_EQ(aligned({}, 1), "");
  EXPECT_EQ(duration(12.4), "12 s");
  EXPECT_EQ(duration(185), "3 min 05 s");
  EXPECT_EQ(duration(9000), "2.5 h");
}

}  // namespace
}  // namespace undex::study
