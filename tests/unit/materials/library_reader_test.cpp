// Texts of the library: what is wrong in one is named.
#include "materials/library_reader.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace undex::materials {
namespace {

const std::string head = R"(kind = "gas"
[[set]]
name = "x"
source = "somewhere"
grade = "C"
checked = "nothing"
valid = [0, 1e9]
)";

std::string refusal(const std::string& text) {
  try {
    read_sets({text});
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST(LibraryReader, ReadsWhatItIsGiven) {
  const std::string text = head + "law = \"ideal_gas\"\nrho0 = 2\ngamma = 1.5\n";
  const Sets sets = read_sets({text});
  ASSERT_EQ(sets.fluids.size(), 1u);
  EXPECT_EQ(sets.fluids[0].rho0, 2);
  EXPECT_EQ(std::get<IdealGas>(sets.fluids[0].law).parameters().gamma, 1.5);
  EXPECT_EQ(sets.pedigrees[0].kind, "gas");
  EXPECT_EQ(sets.pedigrees[0].valid_to, 1e9);
}

TEST(LibraryReader, NamesTheSetAndTheKey) {
  EXPECT_EQ(refusal(head + "law = \"ideal_gas\"\nrho0 = 2\n"), "materials/data: x.gamma: is missing");
  EXPECT_EQ(refusal(head + "law = \"ideal\"\nrho0 = 2\n"), "materials/data: x.law: is not known");
  EXPECT_EQ(refusal(head + "law = \"ideal_gas\"\nrho0 = 2\ngamma = 1.4\np_inf = 3\n"), "materials/data: x.p_inf: is not known");
  EXPECT_EQ(refusal(head + "law = \"ideal_gas\"\nrho0 = \"2\"\ngamma = 1.4\n"), "materials/data: x.rho0: has another type");
  EXPECT_EQ(refusal(head + "rho0 = 2\nyoung_modulus = 1e9\n"), "materials/data: x.poisson_ratio: is missing");
  EXPECT_EQ(refusal(head + "base = \"y\"\n"), "materials/data: x.base: is no solid before it");
  EXPECT_EQ(refusal(head + "law = \"tait\"\ncavitation = \"none at all\"\n"), "materials/data: x.cavitation: has another word");
  EXPECT_NE(refusal("kind = \"gas\"\n").find("[[set]]"), std::string::npos);
  EXPECT_NE(refusal("kind = \n").find("line 1"), std::string::npos);
}

TEST(LibraryReader, EverySetHasItsPedigree) {
  const Sets sets = read_sets(library_texts());
  EXPECT_EQ(sets.pedigrees.size(), sets.fluids.size() + sets.solids.size());
  std::set<std::string> names;
  for (const Pedigree& p : sets.pedigrees) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_TRUE(p.grade.size() == 1 && std::string("ABCD").find(p.grade) != std::string::npos) << p.name;
    EXPECT_TRUE((std::set<std::string>{"water", "explosive", "gas", "metal"}.contains(p.kind))) << p.name;
    EXPECT_GT(p.checked.size(), 10u) << p.name;
    EXPECT_LT(p.valid_from, p.valid_to) << p.name;
    EXPECT_EQ(find_pedigree(p.name)->checked, p.checked);
  }
  EXPECT_FALSE(find_pedigree("tnt ").has_value());
}

}  // namespace
}  // namespace undex::materials
