#pragma once

// The grammar of macro source, one line at a time. Private to assembler/. Commands, directives and
// their operands share one form, so a new row of spec/macro.def needs no change here.
//
//   roll speed=128 heading=90deg, delay=0.2s   # remark
//   .macro square id=40 flags=motor_control,endsig
//   comment "lap \"one\""

#include "base/peg.h"

namespace orb::assembler::grammar {

using namespace tao::pegtl;

// clang-format off

struct _              : star<blank> {};

struct escape         : seq<one<'\\'>, sor<one<'"', '\\', 'n', 'r', 't', '0'>, seq<one<'x'>, xdigit, xdigit>>> {};
struct character      : sor<escape, not_one<'"', '\\'>> {};
struct closing_quote  : one<'"'> {};
struct text           : seq<one<'"'>, star<character>, must<closing_quote>> {};

struct hexadecimal    : seq<one<'0'>, one<'x', 'X'>, plus<xdigit>> {};
struct decimal        : seq<plus<digit>, opt<one<'.'>, plus<digit>>> {};
struct unit           : star<identifier_other> {};
struct number         : seq<opt<one<'-', '+'>>, sor<hexadecimal, decimal>, unit> {};

struct word           : identifier {};
struct assigned       : sor<number, word, text> {};
struct equals         : seq<one<'='>, _> {};
struct word_operand   : seq<word, _, opt<equals, must<assigned>>> {};
struct operand        : seq<sor<word_operand, number, text>, _> {};
struct next_operand   : operand {};
struct comma          : seq<one<','>, _, must<next_operand>> {};
struct operands       : opt<operand, star<sor<operand, comma>>> {};

struct directive      : seq<one<'.'>, identifier> {};
struct mnemonic       : identifier {};
struct head           : sor<mnemonic, directive> {};
struct remark         : seq<one<'#', ';'>, until<eof>> {};
struct nothing_more   : eof {};
struct line           : seq<_, opt<head, _, operands>, opt<remark>, must<nothing_more>> {};

// clang-format on

} // namespace orb::assembler::grammar
