#pragma once

// The grammar of structured orbBasic. Private to structured/text: only matching.h includes it.
//
// Every rule consumes the gap after it. A gap is whitespace, inside brackets also line endings and
// comments; after a comma or an operator the line always continues (`join`). The first token
// selects the rule; must<> marks required parts. Rules that look up a word, or that depend on a
// table row, are matched by hand in matching.h.

#include "base/peg.h"

#include <tao/pegtl/contrib/analyze_traits.hpp>

namespace orb::structured {
class Builder;
}

namespace orb::structured::grammar {

using namespace tao::pegtl;

// clang-format off

ORB_BY_HAND(gap)
ORB_BY_HAND(join)

struct name_char      : sor<alnum, one<'_'>> {};
struct name           : seq<sor<alpha, one<'_'>>, star<name_char>> {};

template <char... Letters>
struct particle       : seq<istring<Letters...>, not_at<name_char>> {};

struct word_to        : seq<particle<'t', 'o'>, gap> {};
struct word_step      : seq<particle<'s', 't', 'e', 'p'>, gap> {};
struct word_then      : seq<particle<'t', 'h', 'e', 'n'>, gap> {};
struct not_word       : particle<'n', 'o', 't'> {};
struct word_not       : seq<not_word, gap> {};
struct word_and       : seq<particle<'a', 'n', 'd'>, join> {};
struct word_or        : seq<particle<'o', 'r'>, join> {};

// expressions and conditions

struct condition;

struct comma          : seq<one<','>, join> {};
struct numeral        : seq<digit, star<sor<name_char, one<'.'>>>> {};
struct group_begin    : one<'('> {};
struct group_end      : one<')'> {};
struct group          : seq<group_begin, gap, must<condition>, must<group_end>> {};
struct element_end    : one<']'> {};
ORB_BY_HAND(named_factor) // a name, an element, a call, a system variable or a function
struct positive       : sor<numeral, named_factor, group> {};
struct negation       : seq<one<'-'>, gap, must<positive>> {};
struct factor         : seq<sor<positive, negation>, gap> {};
struct last_brace     : seq<one<'{', '}'>, star<blank>, sor<eolf, one<'\'', '\r'>>> {}; // of another language
struct product_sign   : seq<not_at<sor<two<'/'>, last_brace>>, one<'*', '/', '%', '{', '}'>> {};
struct product_tail   : seq<product_sign, join, must<factor>> {};
struct product        : seq<factor, star<product_tail>> {};
struct sum_sign       : one<'+', '-', '&', '|'> {};
struct sum_tail       : seq<sum_sign, join, must<product>> {};
struct sum            : seq<product, star<sum_tail>> {};
struct relation_sign  : sor<string<'<', '>'>, string<'<', '='>, string<'>', '='>, string<'!', '='>,
                            one<'=', '<', '>', '!'>> {};
struct relation_tail  : seq<relation_sign, join, must<sum>> {};
struct relation       : seq<sum, opt<relation_tail>> {};
struct negated;
struct simple         : sor<negated, relation> {};
struct negated        : seq<word_not, must<simple>> {};
struct and_tail       : seq<word_and, must<simple>> {};
struct both           : seq<simple, star<and_tail>> {};
struct or_tail        : seq<word_or, must<both>> {};
struct condition      : seq<both, star<or_tail>> {};

struct expression     : condition {}; // checked later to be a value

// parts of statements

struct equals         : seq<one<'='>, join> {};
ORB_BY_HAND(place)     // what can be assigned: a name, an element, a timer or `ctrl`
ORB_BY_HAND(new_name)  // the name of a declaration
struct names          : list_must<seq<new_name, gap>, comma> {};
struct parameters_end : one<')'> {};
struct parameters     : opt<one<'('>, gap, opt<names>, must<parameters_end>, gap> {};
struct text           : seq<one<'"'>, star<not_one<'"', '\n', '\r'>>, must<one<'"'>>> {};
struct file_name      : seq<text, gap> {};
struct print_comma    : one<','> {};
struct semicolon      : one<';'> {};
struct character_sign : one<'$'> {};
struct character      : seq<character_sign, gap, must<expression>> {};
struct print_item     : sor<seq<print_comma, join>, seq<sor<text, semicolon>, gap>, character, expression> {};

// the syntax after the word of a statement

struct output         : star<print_item> {};
struct one_value      : must<expression> {};
struct values         : list_must<expression, comma> {};
struct places         : list_must<place, comma> {};
struct entry          : seq<must<place>, opt<comma, must<expression>, comma, must<expression>>> {};
struct constant       : seq<must<new_name>, gap, must<equals>, must<expression>> {};
struct array_begin    : one<'['> {};
struct array          : seq<must<new_name>, gap, must<array_begin>, gap, must<expression>, must<element_end>, gap> {};
struct counting       : seq<must<place>, must<equals>, must<expression>, must<word_to>, must<expression>,
                            opt<word_step, must<expression>>> {};
struct counted        : opt<place> {};
struct to_word        : word_to {};
struct case_value     : seq<expression, opt<to_word, must<expression>>> {};
struct case_values    : list_must<case_value, comma> {};
struct result         : opt<expression> {};
struct routine        : seq<must<new_name>, gap, parameters> {};
struct locals         : must<names> {};
struct jump           : seq<must<new_name>, gap> {};
struct file           : must<file_name> {};
ORB_BY_HAND(arguments) // one expression per parameter of the statement's row

// clang-format on

} // namespace orb::structured::grammar

namespace tao::pegtl {

namespace orb_structured = orb::structured::grammar;

template <typename Name>
struct analyze_traits<Name, orb_structured::gap> : analyze_opt_traits<> {};
template <typename Name>
struct analyze_traits<Name, orb_structured::join> : analyze_opt_traits<> {};
template <typename Name>
struct analyze_traits<Name, orb_structured::named_factor>
    : analyze_seq_traits<orb_structured::name, opt<orb_structured::condition>> {};
template <typename Name>
struct analyze_traits<Name, orb_structured::place>
    : analyze_seq_traits<orb_structured::name, opt<orb_structured::condition>> {};
template <typename Name>
struct analyze_traits<Name, orb_structured::new_name> : analyze_seq_traits<orb_structured::name> {};
template <typename Name>
struct analyze_traits<Name, orb_structured::arguments>
    : analyze_opt_traits<orb_structured::expression, orb_structured::comma> {};

} // namespace tao::pegtl
