#pragma once

// The grammar of orbBasic as the robot reads it. Private to compiler/: only parse_basic.cpp and the
// tests of the grammar include it.
//
// Every rule consumes the spaces after it. The first token selects the rule, so nothing is parsed
// twice; must<> marks required parts, and compiler/text/parse_basic.cpp gives the error for each.
// Three rules look up a word in the tables of spec/ and continue by its kind (word_statement,
// named_factor, arguments): a new statement of the usual form needs a new row there and no change
// here.

#include "base/peg.h"

#include <tao/pegtl/contrib/analyze_traits.hpp>

namespace orb::compiler {
class Builder;
}

namespace orb::compiler::grammar {

using namespace tao::pegtl;

// The rules that look up a word. parse_basic.cpp matches them by hand; their content is declared
// here again for analyze(), which proves that no loop runs without progress.
// clang-format off

struct _    : star<blank> {};
struct word : plus<alpha> {};

template <char... Letters>
struct particle : seq<string<Letters...>, not_at<alpha>, _> {};

struct word_then  : particle<'t', 'h', 'e', 'n'> {};
struct word_else  : particle<'e', 'l', 's', 'e'> {};
struct word_and   : particle<'a', 'n', 'd'> {};
struct word_or    : particle<'o', 'r'> {};
struct word_to    : particle<'t', 'o'> {};
struct word_step  : particle<'s', 't', 'e', 'p'> {};
struct word_goto  : particle<'g', 'o', 't', 'o'> {};
struct word_gosub : particle<'g', 'o', 's', 'u', 'b'> {};

// expressions

struct sum;

ORB_BY_HAND(number)        // digits
struct group_begin    : one<'('> {};
struct group_end      : one<')'> {};
struct group          : seq<group_begin, _, must<sum>, must<group_end>> {};
struct call_operand   : seq<_, must<sum>> {};
ORB_BY_HAND(named_factor)  // a letter, a system variable, or a function and call_operand
struct positive       : sor<seq<at<digit>, number>, seq<at<alpha>, named_factor>, group> {};
struct negation       : seq<one<'-'>, _, must<positive>> {};
struct factor         : seq<sor<positive, negation>, _> {};
struct product_sign   : one<'*', '/', '%', '{', '}'> {};
struct product_tail   : seq<product_sign, _, must<factor>> {};
struct product_tails  : star<at<product_sign>, product_tail> {}; // at: most have no tail
struct product        : seq<factor, product_tails> {};
struct sum_sign       : one<'+', '-', '&', '|'> {};
struct sum_tail       : seq<sum_sign, _, must<product>> {};
struct any_sign       : one<'*', '/', '%', '{', '}', '+', '-', '&', '|'> {};
struct sum_tails      : seq<product_tails, star<at<sum_sign>, sum_tail>> {};
struct sum            : seq<factor, sor<not_at<any_sign>, sum_tails>> {}; // most have no sign

struct expression     : sum {};

// parts of statements

struct comma          : seq<one<','>, _> {};
struct equals         : seq<one<'='>, _> {};
ORB_BY_HAND(user_variable) // A to Z
struct target         : plus<digit> {};
struct targets        : list_must<seq<target, _>, comma> {};
struct relation_sign  : one<'=', '!', '<', '>'> {};
struct relation       : seq<must<expression>, must<relation_sign>, _, must<expression>> {};

struct text           : seq<one<'"'>, star<not_one<'"', '\n', '\r'>>, must<one<'"'>>> {};
struct print_comma    : one<','> {};
struct semicolon      : one<';'> {};
struct character_sign : one<'$'> {};
struct character      : seq<character_sign, _, must<sum>> {};
struct print_item     : sor<seq<sor<text, print_comma, semicolon>, _>, character, expression> {};

// the syntax after the word of a statement, by its spec::Form

struct assignment     : seq<must<equals>, must<expression>> {};
struct branch_line    : seq<must<target>, _> {};
struct on_goto        : word_goto {};
struct on_gosub       : word_gosub {};
struct on_word        : sor<on_goto, on_gosub> {};
struct indexed_branch : seq<must<expression>, must<on_word>, must<targets>> {};
struct loop           : seq<must<user_variable>, must<equals>, must<expression>, must<word_to>,
                            must<expression>, opt<word_step, must<expression>>> {};
struct loop_end       : must<user_variable> {};
struct output         : star<print_item> {};
struct entry          : seq<must<user_variable>,
                            opt<comma, must<expression>, must<comma>, must<expression>>> {};
struct values         : seq<must<expression>, star<comma, must<expression>>> {};
struct variables      : seq<must<user_variable>, star<comma, must<user_variable>>> {};
ORB_BY_HAND(arguments) // one expression per parameter of the statement

struct also_and       : word_and {};
struct also_or        : word_or {};
struct line_end       : sor<eof, at<one<'\n', '\r', '\''>>> {};
struct then_end       : sor<line_end, at<word_else>> {};
ORB_BY_HAND(then_branch) // a statement and then_end; a branch that does not parse becomes a
                         // separate fault
ORB_BY_HAND(else_branch) // the same with line_end
struct conditional    : seq<relation, opt<sor<also_and, also_or>, relation>, must<word_then>,
                            then_branch, opt<word_else, else_branch>> {};

// statements and lines

struct question_mark  : one<'?'> {};
struct short_print    : seq<question_mark, _, output> {};
ORB_BY_HAND(word_statement) // a word and the syntax of its form
struct statement      : sor<word_statement, short_print> {};
struct line_rest      : sor<line_end, seq<must<statement>, must<line_end>>> {}; // after its number

// clang-format on

} // namespace orb::compiler::grammar

namespace tao::pegtl {

namespace orb_grammar = orb::compiler::grammar;

template <typename Name>
struct analyze_traits<Name, orb_grammar::number> : analyze_seq_traits<plus<digit>> {};
template <typename Name>
struct analyze_traits<Name, orb_grammar::named_factor>
    : analyze_seq_traits<orb_grammar::word, opt<orb_grammar::call_operand>> {};
template <typename Name>
struct analyze_traits<Name, orb_grammar::user_variable> : analyze_seq_traits<orb_grammar::word> {};
template <typename Name>
struct analyze_traits<Name, orb_grammar::arguments>
    : analyze_opt_traits<orb_grammar::expression, orb_grammar::comma> {};
template <typename Name>
struct analyze_traits<Name, orb_grammar::then_branch>
    : analyze_seq_traits<orb_grammar::statement, orb_grammar::then_end> {};
template <typename Name>
struct analyze_traits<Name, orb_grammar::else_branch>
    : analyze_seq_traits<orb_grammar::statement, orb_grammar::line_end> {};
template <typename Name>
struct analyze_traits<Name, orb_grammar::word_statement>
    : analyze_seq_traits<orb_grammar::word,
                         sor<orb_grammar::assignment, orb_grammar::conditional, orb_grammar::loop,
                             orb_grammar::loop_end, orb_grammar::branch_line,
                             orb_grammar::indexed_branch, orb_grammar::entry, orb_grammar::values,
                             orb_grammar::variables, orb_grammar::arguments, orb_grammar::output>> {
};

} // namespace tao::pegtl
