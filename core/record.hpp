// Records: the name of a parameter, its unit, range, default and meaning are said once, beside the struct that holds it. A type
// with parameters has in its own namespace
//   template <class Visit> void describe(Type& of, Visit&& visit) { visit(of.member, {.name = "key", ...}); ... }
// which shows each member with its key, in the order in which keys are written. An enumeration has words(Enum), and each
// alternative of a variant a static `name`. Whoever reads, writes, checks, lists or keeps parameters walks these.
#pragma once

#include <array>
#include <utility>

namespace undex {

/// The numbers that a parameter may be; of a vector, each component.
struct Range {
  static constexpr double endless = 1e30, farthest = 1e5;  ///< [m] the latter
  double low = -endless, high = endless;
  bool above_low = false;  ///< must be greater than `low`, not merely at least

  static constexpr Range between(double low, double high) { return {low, high, false}; }
  static constexpr Range above(double low, double high = endless) { return {low, high, true}; }
  static constexpr Range at_least(double low) { return {low, endless, false}; }
  static constexpr Range positive() { return above(0); }
  static constexpr Range position() { return between(-farthest, farthest); }
  static constexpr Range length() { return above(0, farthest); }

  constexpr bool holds(double value) const { return value <= high && (above_low ? value > low : value >= low); }
  constexpr bool is_endless() const { return low <= -endless && high >= endless; }
};

/// How a parameter is written, where its type does not say it.
enum class Form {
  plain,
  name,        ///< text of letters, digits, '_' and '-'
  axis,        ///< 0, 1, 2 as "x", "y", "z"
  scene_axis,  ///< the same, and the scene must have it
  along,       ///< a coordinate along Key::axis, which means nothing where the scene has no such axis
  across,      ///< a point whose coordinate along Key::axis means nothing
  height,      ///< a point, or a number where only the coordinate along gravity counts and gravity is along an axis
  turn,        ///< axis times angle: a vector in three dimensions, a number in two, where only z is left to turn about
};

/// Of what a count must be a multiple, and why.
struct Multiple {
  int of = 1;
  const char* because = "";
  constexpr int next(int count) const { return (count + of - 1) / of * of; }
};

/// What is known of a parameter beside its value.
struct Key {
  const char* name;
  const char* unit = "";  ///< empty: none
  Range range = {};
  bool needed = false;            ///< without a default
  const char* remedy = nullptr;   ///< what to write where a needed one is missing
  const char* rule = nullptr;     ///< its default in words, where it is not the member's own
  const char* values = nullptr;   ///< in words, where type and range do not say what it may be
  const char* greater = nullptr;  ///< name of the key whose value it must exceed
  Multiple multiple = {};         ///< of a whole number
  Form form = Form::plain;
  int axis = 2;                        ///< of the forms `along` and `across`
  const char *yes = "true", *no = "";  ///< words of a bool that has them
  bool used = true;                    ///< does it count in this object? Constants of a model that is not chosen do not
  const char* meaning = "";
};

/// In place of a member: a key whose value is a table, or another spelling of what the members hold.
struct ByHand {};

/// A value of an enumeration and its word.
template <class Enum>
struct Word {
  const char* word;
  Enum value;
};
template <class Enum>
concept Worded = requires(Enum value) {
  words(value)[0].word;
};

/// The word of a value; it has one.
template <Worded Enum>
constexpr const char* word_of(Enum value) {
  for (const Word<Enum>& each : words(value))
    if (each.value == value) return each.word;
  return "";
}

/// Can a type's parameters be walked?
struct AnyVisitor {
  template <class Member>
  constexpr void operator()(Member&&, const Key&) const {}
};
template <class Type>
concept Described = requires(Type& of) {
  describe(of, AnyVisitor{});
};

/// Calls visit(member, key) for every parameter, in the order in which they are written.
template <Described Type>
void for_each_field(Type& of, auto&& visit) {
  describe(of, visit);
}
/// The same of a constant object: members are constant too.
template <Described Type>
void for_each_field(const Type& of, auto&& visit) {
  describe(const_cast<Type&>(of), [&](auto&& member, const Key& key) { visit(std::as_const(member), key); });
}

}  // namespace undex
