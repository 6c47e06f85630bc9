#pragma once

#include <tao/pegtl.hpp>

// What the three parsers share (compiler/, assembler/, structured/): rules of PEGTL that are
// matched by hand, what a rule does, and what is reported where a rule that must match does not.
// Each parser brings, in its own namespace, a Builder, a Stop that ends the parse of a line, and
// `template <typename Rule> constexpr … reason` with what Stop says. Only parsers include this: it
// takes a second to compile.

/// What stands before a function that goes on with other rules.
#define ORB_RULE_TEMPLATE                                                                          \
  template <apply_mode A, rewind_mode M, template <typename...> class Action,                      \
            template <typename...> class Control, typename Input>

/// A rule that is matched by hand, in ORB_MATCH(name). What it consumes is said to analyze(), which
/// proves that no loop stands still, by analyze_traits.
#define ORB_BY_HAND(name)                                                                          \
  struct name {                                                                                    \
    using rule_t = name;                                                                           \
    using subs_t = empty_list;                                                                     \
    ORB_RULE_TEMPLATE static bool match(Input& in, Builder& builder);                              \
  };
#define ORB_MATCH(name)                                                                            \
  ORB_RULE_TEMPLATE bool name::match([[maybe_unused]] Input& in, [[maybe_unused]] Builder& builder)
/// Whether another rule matches, within ORB_MATCH.
#define ORB_MATCHES(rule) Control<rule>::template match<A, M, Action, Control>(in, builder)

/// What is reported where a rule, which may have commas, must match and does not.
#define ORB_REASON(what, ...)                                                                      \
  template <>                                                                                      \
  inline constexpr auto reason<__VA_ARGS__> = what;

/// Throws a Stop for the rule that should have matched.
#define ORB_CONTROL                                                                                \
  template <typename Rule>                                                                         \
  struct Control : tao::pegtl::normal<Rule> {                                                      \
    template <typename Input>                                                                      \
    [[noreturn]] static void raise(const Input& in, Builder&) {                                    \
      throw Stop{reason<Rule>, in.current()};                                                      \
    }                                                                                              \
  };

/// What is done when `rule` has matched; `in` is what it consumed.
#define ORB_ACTIONS                                                                                \
  template <typename Rule>                                                                         \
  struct Action : tao::pegtl::nothing<Rule> {};
#define ORB_ACTION(rule, body)                                                                     \
  template <>                                                                                      \
  struct Action<rule> {                                                                            \
    template <typename Input>                                                                      \
    static void apply([[maybe_unused]] const Input& in, Builder& builder) {                        \
      body;                                                                                        \
    }                                                                                              \
  };

namespace orb::peg {

/// A text that is parsed, whose lines are nobody's business.
using Input =
    tao::pegtl::memory_input<tao::pegtl::tracking_mode::lazy, tao::pegtl::eol::lf, const char*>;

} // namespace orb::peg
