// Variants of a scene: the alternative that a word names.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/record.hpp"

namespace undex::scene {

/// What describes an alternative: the alternative itself, or the parameters that it is made of.
template <class Type>
struct ParametersIn {
  using Of = Type;
};
template <class Type>
requires requires { typename Type::Parameters; }
struct ParametersIn<Type> {
  using Of = typename Type::Parameters;
};
template <class Type>
using ParametersOf = typename ParametersIn<Type>::Of;

/// The alternatives of a variant by their names.
template <class Variant>
struct Alternatives;
template <class... Types>
struct Alternatives<std::variant<Types...>> {
  static std::vector<std::string> names() { return {Types::name...}; }
  /// Of those for which is_meant(std::type_identity<Type>) holds.
  static std::vector<std::string> names(auto&& is_meant) {
    std::vector<std::string> some;
    some.reserve(sizeof...(Types));
    ((is_meant(std::type_identity<Types>{}) ? some.push_back(std::string(Types::name)) : void()), ...);
    return some;
  }
  /// Calls visit(std::type_identity<Type>) for the alternative of that name; false where there is none.
  static bool with(std::string_view name, auto&& visit) {
    return ((name == Types::name && (visit(std::type_identity<Types>{}), true)) || ...);
  }
};

/// The name of the alternative that is held.
template <class Variant>
const char* name_of(const Variant& held) {
  return std::visit([](const auto& each) { return each.name; }, held);
}

}  // namespace undex::scene
