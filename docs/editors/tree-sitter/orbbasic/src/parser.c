// Made from grammar.js (966f32191b0cec079eb8bd36954631454b7967017d1326efdb283a47e298e84c) by `./dev grammars`.
#include "tree_sitter/parser.h"

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif

#define LANGUAGE_VERSION 14
#define STATE_COUNT 115
#define LARGE_STATE_COUNT 2
#define SYMBOL_COUNT 64
#define ALIAS_COUNT 0
#define TOKEN_COUNT 37
#define EXTERNAL_TOKEN_COUNT 0
#define FIELD_COUNT 8
#define MAX_ALIAS_SEQUENCE_LENGTH 8
#define PRODUCTION_ID_COUNT 13

enum ts_symbol_identifiers {
  sym__word = 1,
  aux_sym_program_token1 = 2,
  aux_sym_line_number_token1 = 3,
  sym__line_end = 4,
  anon_sym_let = 5,
  anon_sym_EQ = 6,
  anon_sym_if = 7,
  anon_sym_and = 8,
  anon_sym_or = 9,
  anon_sym_then = 10,
  anon_sym_else = 11,
  aux_sym_relation_token1 = 12,
  anon_sym_for = 13,
  anon_sym_to = 14,
  anon_sym_step = 15,
  anon_sym_next = 16,
  anon_sym_goto = 17,
  anon_sym_gosub = 18,
  anon_sym_on = 19,
  anon_sym_COMMA = 20,
  anon_sym_print = 21,
  anon_sym_QMARK = 22,
  anon_sym_SEMI = 23,
  anon_sym_DOLLAR = 24,
  sym_action_word = 25,
  sym_control_word = 26,
  anon_sym_LPAREN = 27,
  anon_sym_RPAREN = 28,
  anon_sym_DASH = 29,
  aux_sym_product_token1 = 30,
  aux_sym_sum_token1 = 31,
  sym_function_word = 32,
  sym_system_variable = 33,
  sym_variable = 34,
  sym_string = 35,
  sym_comment = 36,
  sym_program = 37,
  sym__content = 38,
  sym_line = 39,
  sym_line_number = 40,
  sym__statement = 41,
  sym__in_branch = 42,
  sym_assignment = 43,
  sym_conditional = 44,
  sym_relation = 45,
  sym_loop = 46,
  sym_loop_end = 47,
  sym_jump = 48,
  sym_indexed_jump = 49,
  sym__target = 50,
  sym_output = 51,
  sym_action = 52,
  sym__expression = 53,
  sym_group = 54,
  sym_negation = 55,
  sym_product = 56,
  sym_sum = 57,
  sym_call = 58,
  sym_number = 59,
  aux_sym_program_repeat1 = 60,
  aux_sym_indexed_jump_repeat1 = 61,
  aux_sym_output_repeat1 = 62,
  aux_sym_action_repeat1 = 63,
};

static const char * const ts_symbol_names[] = {
  [ts_builtin_sym_end] = "end",
  [sym__word] = "_word",
  [aux_sym_program_token1] = "program_token1",
  [aux_sym_line_number_token1] = "line_number_token1",
  [sym__line_end] = "_line_end",
  [anon_sym_let] = "let",
  [anon_sym_EQ] = "=",
  [anon_sym_if] = "if",
  [anon_sym_and] = "and",
  [anon_sym_or] = "or",
  [anon_sym_then] = "then",
  [anon_sym_else] = "else",
  [aux_sym_relation_token1] = "operator",
  [anon_sym_for] = "for",
  [anon_sym_to] = "to",
  [anon_sym_step] = "step",
  [anon_sym_next] = "next",
  [anon_sym_goto] = "goto",
  [anon_sym_gosub] = "gosub",
  [anon_sym_on] = "on",
  [anon_sym_COMMA] = ",",
  [anon_sym_print] = "print",
  [anon_sym_QMARK] = "\?",
  [anon_sym_SEMI] = ";",
  [anon_sym_DOLLAR] = "$",
  [sym_action_word] = "action_word",
  [sym_control_word] = "control_word",
  [anon_sym_LPAREN] = "(",
  [anon_sym_RPAREN] = ")",
  [anon_sym_DASH] = "-",
  [aux_sym_product_token1] = "operator",
  [aux_sym_sum_token1] = "operator",
  [sym_function_word] = "function_word",
  [sym_system_variable] = "system_variable",
  [sym_variable] = "variable",
  [sym_string] = "string",
  [sym_comment] = "comment",
  [sym_program] = "program",
  [sym__content] = "_content",
  [sym_line] = "line",
  [sym_line_number] = "line_number",
  [sym__statement] = "_statement",
  [sym__in_branch] = "_in_branch",
  [sym_assignment] = "assignment",
  [sym_conditional] = "conditional",
  [sym_relation] = "relation",
  [sym_loop] = "loop",
  [sym_loop_end] = "loop_end",
  [sym_jump] = "jump",
  [sym_indexed_jump] = "indexed_jump",
  [sym__target] = "_target",
  [sym_output] = "output",
  [sym_action] = "action",
  [sym__expression] = "_expression",
  [sym_group] = "group",
  [sym_negation] = "negation",
  [sym_product] = "product",
  [sym_sum] = "sum",
  [sym_call] = "call",
  [sym_number] = "number",
  [aux_sym_program_repeat1] = "program_repeat1",
  [aux_sym_indexed_jump_repeat1] = "indexed_jump_repeat1",
  [aux_sym_output_repeat1] = "output_repeat1",
  [aux_sym_action_repeat1] = "action_repeat1",
};

static const TSSymbol ts_symbol_map[] = {
  [ts_builtin_sym_end] = ts_builtin_sym_end,
  [sym__word] = sym__word,
  [aux_sym_program_token1] = aux_sym_program_token1,
  [aux_sym_line_number_token1] = aux_sym_line_number_token1,
  [sym__line_end] = sym__line_end,
  [anon_sym_let] = anon_sym_let,
  [anon_sym_EQ] = anon_sym_EQ,
  [anon_sym_if] = anon_sym_if,
  [anon_sym_and] = anon_sym_and,
  [anon_sym_or] = anon_sym_or,
  [anon_sym_then] = anon_sym_then,
  [anon_sym_else] = anon_sym_else,
  [aux_sym_relation_token1] = aux_sym_relation_token1,
  [anon_sym_for] = anon_sym_for,
  [anon_sym_to] = anon_sym_to,
  [anon_sym_step] = anon_sym_step,
  [anon_sym_next] = anon_sym_next,
  [anon_sym_goto] = anon_sym_goto,
  [anon_sym_gosub] = anon_sym_gosub,
  [anon_sym_on] = anon_sym_on,
  [anon_sym_COMMA] = anon_sym_COMMA,
  [anon_sym_print] = anon_sym_print,
  [anon_sym_QMARK] = anon_sym_QMARK,
  [anon_sym_SEMI] = anon_sym_SEMI,
  [anon_sym_DOLLAR] = anon_sym_DOLLAR,
  [sym_action_word] = sym_action_word,
  [sym_control_word] = sym_control_word,
  [anon_sym_LPAREN] = anon_sym_LPAREN,
  [anon_sym_RPAREN] = anon_sym_RPAREN,
  [anon_sym_DASH] = anon_sym_DASH,
  [aux_sym_product_token1] = aux_sym_relation_token1,
  [aux_sym_sum_token1] = aux_sym_relation_token1,
  [sym_function_word] = sym_function_word,
  [sym_system_variable] = sym_system_variable,
  [sym_variable] = sym_variable,
  [sym_string] = sym_string,
  [sym_comment] = sym_comment,
  [sym_program] = sym_program,
  [sym__content] = sym__content,
  [sym_line] = sym_line,
  [sym_line_number] = sym_line_number,
  [sym__statement] = sym__statement,
  [sym__in_branch] = sym__in_branch,
  [sym_assignment] = sym_assignment,
  [sym_conditional] = sym_conditional,
  [sym_relation] = sym_relation,
  [sym_loop] = sym_loop,
  [sym_loop_end] = sym_loop_end,
  [sym_jump] = sym_jump,
  [sym_indexed_jump] = sym_indexed_jump,
  [sym__target] = sym__target,
  [sym_output] = sym_output,
  [sym_action] = sym_action,
  [sym__expression] = sym__expression,
  [sym_group] = sym_group,
  [sym_negation] = sym_negation,
  [sym_product] = sym_product,
  [sym_sum] = sym_sum,
  [sym_call] = sym_call,
  [sym_number] = sym_number,
  [aux_sym_program_repeat1] = aux_sym_program_repeat1,
  [aux_sym_indexed_jump_repeat1] = aux_sym_indexed_jump_repeat1,
  [aux_sym_output_repeat1] = aux_sym_output_repeat1,
  [aux_sym_action_repeat1] = aux_sym_action_repeat1,
};

static const TSSymbolMetadata ts_symbol_metadata[] = {
  [ts_builtin_sym_end] = {
    .visible = false,
    .named = true,
  },
  [sym__word] = {
    .visible = false,
    .named = true,
  },
  [aux_sym_program_token1] = {
    .visible = false,
    .named = false,
  },
  [aux_sym_line_number_token1] = {
    .visible = false,
    .named = false,
  },
  [sym__line_end] = {
    .visible = false,
    .named = true,
  },
  [anon_sym_let] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_EQ] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_if] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_and] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_or] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_then] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_else] = {
    .visible = true,
    .named = false,
  },
  [aux_sym_relation_token1] = {
    .visible = true,
    .named = true,
  },
  [anon_sym_for] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_to] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_step] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_next] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_goto] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_gosub] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_on] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_COMMA] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_print] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_QMARK] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_SEMI] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_DOLLAR] = {
    .visible = true,
    .named = false,
  },
  [sym_action_word] = {
    .visible = true,
    .named = true,
  },
  [sym_control_word] = {
    .visible = true,
    .named = true,
  },
  [anon_sym_LPAREN] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_RPAREN] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_DASH] = {
    .visible = true,
    .named = false,
  },
  [aux_sym_product_token1] = {
    .visible = true,
    .named = true,
  },
  [aux_sym_sum_token1] = {
    .visible = true,
    .named = true,
  },
  [sym_function_word] = {
    .visible = true,
    .named = true,
  },
  [sym_system_variable] = {
    .visible = true,
    .named = true,
  },
  [sym_variable] = {
    .visible = true,
    .named = true,
  },
  [sym_string] = {
    .visible = true,
    .named = true,
  },
  [sym_comment] = {
    .visible = true,
    .named = true,
  },
  [sym_program] = {
    .visible = true,
    .named = true,
  },
  [sym__content] = {
    .visible = false,
    .named = true,
  },
  [sym_line] = {
    .visible = true,
    .named = true,
  },
  [sym_line_number] = {
    .visible = true,
    .named = true,
  },
  [sym__statement] = {
    .visible = false,
    .named = true,
  },
  [sym__in_branch] = {
    .visible = false,
    .named = true,
  },
  [sym_assignment] = {
    .visible = true,
    .named = true,
  },
  [sym_conditional] = {
    .visible = true,
    .named = true,
  },
  [sym_relation] = {
    .visible = true,
    .named = true,
  },
  [sym_loop] = {
    .visible = true,
    .named = true,
  },
  [sym_loop_end] = {
    .visible = true,
    .named = true,
  },
  [sym_jump] = {
    .visible = true,
    .named = true,
  },
  [sym_indexed_jump] = {
    .visible = true,
    .named = true,
  },
  [sym__target] = {
    .visible = false,
    .named = true,
  },
  [sym_output] = {
    .visible = true,
    .named = true,
  },
  [sym_action] = {
    .visible = true,
    .named = true,
  },
  [sym__expression] = {
    .visible = false,
    .named = true,
  },
  [sym_group] = {
    .visible = true,
    .named = true,
  },
  [sym_negation] = {
    .visible = true,
    .named = true,
  },
  [sym_product] = {
    .visible = true,
    .named = true,
  },
  [sym_sum] = {
    .visible = true,
    .named = true,
  },
  [sym_call] = {
    .visible = true,
    .named = true,
  },
  [sym_number] = {
    .visible = true,
    .named = true,
  },
  [aux_sym_program_repeat1] = {
    .visible = false,
    .named = false,
  },
  [aux_sym_indexed_jump_repeat1] = {
    .visible = false,
    .named = false,
  },
  [aux_sym_output_repeat1] = {
    .visible = false,
    .named = false,
  },
  [aux_sym_action_repeat1] = {
    .visible = false,
    .named = false,
  },
};

enum ts_field_identifiers {
  field_else = 1,
  field_function = 2,
  field_left = 3,
  field_name = 4,
  field_number = 5,
  field_right = 6,
  field_then = 7,
  field_variable = 8,
};

static const char * const ts_field_names[] = {
  [0] = NULL,
  [field_else] = "else",
  [field_function] = "function",
  [field_left] = "left",
  [field_name] = "name",
  [field_number] = "number",
  [field_right] = "right",
  [field_then] = "then",
  [field_variable] = "variable",
};

static const TSFieldMapSlice ts_field_map_slices[PRODUCTION_ID_COUNT] = {
  [1] = {.index = 0, .length = 1},
  [2] = {.index = 1, .length = 1},
  [3] = {.index = 2, .length = 1},
  [5] = {.index = 3, .length = 1},
  [6] = {.index = 4, .length = 2},
  [7] = {.index = 6, .length = 2},
  [8] = {.index = 8, .length = 1},
  [10] = {.index = 9, .length = 1},
  [11] = {.index = 10, .length = 2},
  [12] = {.index = 12, .length = 2},
};

static const TSFieldMapEntry ts_field_map_entries[] = {
  [0] =
    {field_number, 0},
  [1] =
    {field_name, 0},
  [2] =
    {field_variable, 1},
  [3] =
    {field_function, 0},
  [4] =
    {field_left, 0},
    {field_right, 2},
  [6] =
    {field_left, 1},
    {field_right, 3},
  [8] =
    {field_then, 3},
  [9] =
    {field_then, 5},
  [10] =
    {field_else, 5},
    {field_then, 3},
  [12] =
    {field_else, 7},
    {field_then, 5},
};

static const TSSymbol ts_alias_sequences[PRODUCTION_ID_COUNT][MAX_ALIAS_SEQUENCE_LENGTH] = {
  [0] = {0},
  [4] = {
    [0] = sym_line_number,
  },
  [9] = {
    [1] = aux_sym_relation_token1,
  },
};

static const uint16_t ts_non_terminal_alias_map[] = {
  sym_number, 2,
    sym_number,
    sym_line_number,
  0,
};

static const TSStateId ts_primary_state_ids[STATE_COUNT] = {
  [0] = 0,
  [1] = 1,
  [2] = 2,
  [3] = 3,
  [4] = 4,
  [5] = 5,
  [6] = 5,
  [7] = 3,
  [8] = 4,
  [9] = 9,
  [10] = 10,
  [11] = 11,
  [12] = 12,
  [13] = 13,
  [14] = 14,
  [15] = 15,
  [16] = 16,
  [17] = 17,
  [18] = 18,
  [19] = 19,
  [20] = 13,
  [21] = 21,
  [22] = 22,
  [23] = 19,
  [24] = 24,
  [25] = 15,
  [26] = 18,
  [27] = 17,
  [28] = 16,
  [29] = 14,
  [30] = 24,
  [31] = 22,
  [32] = 17,
  [33] = 14,
  [34] = 16,
  [35] = 19,
  [36] = 18,
  [37] = 15,
  [38] = 38,
  [39] = 39,
  [40] = 40,
  [41] = 41,
  [42] = 42,
  [43] = 43,
  [44] = 44,
  [45] = 40,
  [46] = 46,
  [47] = 47,
  [48] = 48,
  [49] = 49,
  [50] = 50,
  [51] = 51,
  [52] = 52,
  [53] = 53,
  [54] = 41,
  [55] = 52,
  [56] = 40,
  [57] = 46,
  [58] = 53,
  [59] = 52,
  [60] = 53,
  [61] = 61,
  [62] = 46,
  [63] = 41,
  [64] = 61,
  [65] = 65,
  [66] = 66,
  [67] = 67,
  [68] = 68,
  [69] = 69,
  [70] = 70,
  [71] = 71,
  [72] = 72,
  [73] = 73,
  [74] = 74,
  [75] = 75,
  [76] = 76,
  [77] = 77,
  [78] = 78,
  [79] = 79,
  [80] = 80,
  [81] = 81,
  [82] = 82,
  [83] = 83,
  [84] = 84,
  [85] = 85,
  [86] = 86,
  [87] = 87,
  [88] = 88,
  [89] = 85,
  [90] = 90,
  [91] = 85,
  [92] = 92,
  [93] = 93,
  [94] = 94,
  [95] = 95,
  [96] = 96,
  [97] = 97,
  [98] = 98,
  [99] = 99,
  [100] = 100,
  [101] = 101,
  [102] = 102,
  [103] = 103,
  [104] = 104,
  [105] = 105,
  [106] = 106,
  [107] = 107,
  [108] = 108,
  [109] = 109,
  [110] = 110,
  [111] = 111,
  [112] = 112,
  [113] = 113,
  [114] = 114,
};

static bool ts_lex(TSLexer *lexer, TSStateId state) {
  START_LEXER();
  eof = lexer->eof(lexer);
  switch (state) {
    case 0:
      if (eof) ADVANCE(4);
      ADVANCE_MAP(
        '\n', 7,
        '\r', 8,
        '"', 1,
        '$', 14,
        '\'', 21,
        '(', 15,
        ')', 16,
        ',', 11,
        '-', 17,
        ';', 13,
        '=', 9,
        '?', 12,
        0xfeff, 5,
      );
      if (lookahead == '\t' ||
          lookahead == ' ') SKIP(0);
      if (lookahead == '!' ||
          ('<' <= lookahead && lookahead <= '>')) ADVANCE(10);
      if (lookahead == '&' ||
          lookahead == '+' ||
          lookahead == '|') ADVANCE(19);
      if (('%' <= lookahead && lookahead <= '*') ||
          lookahead == '/' ||
          ('{' <= lookahead && lookahead <= '}')) ADVANCE(18);
      if (('0' <= lookahead && lookahead <= '9')) ADVANCE(6);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(22);
      END_STATE();
    case 1:
      if (lookahead == '"') ADVANCE(20);
      if (lookahead != 0 &&
          lookahead != '\n' &&
          lookahead != '\r') ADVANCE(1);
      END_STATE();
    case 2:
      if (lookahead == '=') ADVANCE(9);
      if (lookahead == '\t' ||
          lookahead == ' ') SKIP(2);
      END_STATE();
    case 3:
      if (eof) ADVANCE(4);
      if (lookahead == '\n') ADVANCE(7);
      if (lookahead == '\r') ADVANCE(8);
      if (lookahead == '\'') ADVANCE(21);
      if (lookahead == ')') ADVANCE(16);
      if (lookahead == ',') ADVANCE(11);
      if (lookahead == '-') ADVANCE(17);
      if (lookahead == '\t' ||
          lookahead == ' ') SKIP(3);
      if (lookahead == '&' ||
          lookahead == '+' ||
          lookahead == '|') ADVANCE(19);
      if (lookahead == '!' ||
          ('<' <= lookahead && lookahead <= '>')) ADVANCE(10);
      if (lookahead == '%' ||
          lookahead == '*' ||
          lookahead == '/' ||
          ('{' <= lookahead && lookahead <= '}')) ADVANCE(18);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(22);
      END_STATE();
    case 4:
      ACCEPT_TOKEN(ts_builtin_sym_end);
      END_STATE();
    case 5:
      ACCEPT_TOKEN(aux_sym_program_token1);
      END_STATE();
    case 6:
      ACCEPT_TOKEN(aux_sym_line_number_token1);
      if (('0' <= lookahead && lookahead <= '9')) ADVANCE(6);
      END_STATE();
    case 7:
      ACCEPT_TOKEN(sym__line_end);
      END_STATE();
    case 8:
      ACCEPT_TOKEN(sym__line_end);
      if (lookahead == '\n') ADVANCE(7);
      END_STATE();
    case 9:
      ACCEPT_TOKEN(anon_sym_EQ);
      END_STATE();
    case 10:
      ACCEPT_TOKEN(aux_sym_relation_token1);
      END_STATE();
    case 11:
      ACCEPT_TOKEN(anon_sym_COMMA);
      END_STATE();
    case 12:
      ACCEPT_TOKEN(anon_sym_QMARK);
      END_STATE();
    case 13:
      ACCEPT_TOKEN(anon_sym_SEMI);
      END_STATE();
    case 14:
      ACCEPT_TOKEN(anon_sym_DOLLAR);
      END_STATE();
    case 15:
      ACCEPT_TOKEN(anon_sym_LPAREN);
      END_STATE();
    case 16:
      ACCEPT_TOKEN(anon_sym_RPAREN);
      END_STATE();
    case 17:
      ACCEPT_TOKEN(anon_sym_DASH);
      END_STATE();
    case 18:
      ACCEPT_TOKEN(aux_sym_product_token1);
      END_STATE();
    case 19:
      ACCEPT_TOKEN(aux_sym_sum_token1);
      END_STATE();
    case 20:
      ACCEPT_TOKEN(sym_string);
      END_STATE();
    case 21:
      ACCEPT_TOKEN(sym_comment);
      if (lookahead != 0 &&
          lookahead != '\n' &&
          lookahead != '\r') ADVANCE(21);
      END_STATE();
    case 22:
      ACCEPT_TOKEN(sym__word);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(22);
      END_STATE();
    default:
      return false;
  }
}

static bool ts_lex_keywords(TSLexer *lexer, TSStateId state) {
  START_LEXER();
  eof = lexer->eof(lexer);
  switch (state) {
    case 0:
      ADVANCE_MAP(
        'L', 1,
        'Q', 2,
        'R', 3,
        'S', 4,
        'V', 5,
        'a', 6,
        'b', 7,
        'c', 8,
        'd', 9,
        'e', 10,
        'f', 11,
        'g', 12,
        'h', 13,
        'i', 14,
        'l', 15,
        'm', 16,
        'n', 17,
        'o', 18,
        'p', 19,
        'r', 20,
        's', 21,
        't', 22,
        'x', 23,
        'y', 24,
      );
      if (lookahead == '\t' ||
          lookahead == ' ') SKIP(0);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          ('j' <= lookahead && lookahead <= 'z')) ADVANCE(25);
      END_STATE();
    case 1:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'E') ADVANCE(26);
      END_STATE();
    case 2:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'o') ADVANCE(27);
      if (lookahead == 't') ADVANCE(28);
      if (lookahead == 'z') ADVANCE(29);
      END_STATE();
    case 3:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'G') ADVANCE(30);
      END_STATE();
    case 4:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'b') ADVANCE(31);
      END_STATE();
    case 5:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'b') ADVANCE(32);
      END_STATE();
    case 6:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'b') ADVANCE(33);
      if (lookahead == 'c') ADVANCE(34);
      if (lookahead == 'n') ADVANCE(35);
      END_STATE();
    case 7:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'a') ADVANCE(36);
      if (lookahead == 'l') ADVANCE(37);
      END_STATE();
    case 8:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'm') ADVANCE(38);
      if (lookahead == 't') ADVANCE(39);
      END_STATE();
    case 9:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'a') ADVANCE(40);
      if (lookahead == 'e') ADVANCE(41);
      if (lookahead == 's') ADVANCE(42);
      END_STATE();
    case 10:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'l') ADVANCE(43);
      if (lookahead == 'n') ADVANCE(44);
      END_STATE();
    case 11:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'o') ADVANCE(45);
      END_STATE();
    case 12:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'o') ADVANCE(46);
      if (lookahead == 'r') ADVANCE(47);
      if (lookahead == 'y') ADVANCE(48);
      END_STATE();
    case 13:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'd') ADVANCE(49);
      if (lookahead == 'e') ADVANCE(50);
      END_STATE();
    case 14:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'f') ADVANCE(51);
      if (lookahead == 'n') ADVANCE(52);
      if (lookahead == 's') ADVANCE(53);
      END_STATE();
    case 15:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'e') ADVANCE(54);
      if (lookahead == 'o') ADVANCE(55);
      END_STATE();
    case 16:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'a') ADVANCE(56);
      END_STATE();
    case 17:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'e') ADVANCE(57);
      END_STATE();
    case 18:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'n') ADVANCE(58);
      if (lookahead == 'r') ADVANCE(59);
      END_STATE();
    case 19:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'i') ADVANCE(60);
      if (lookahead == 'r') ADVANCE(61);
      END_STATE();
    case 20:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'a') ADVANCE(62);
      if (lookahead == 'e') ADVANCE(63);
      if (lookahead == 'n') ADVANCE(64);
      if (lookahead == 'o') ADVANCE(65);
      if (lookahead == 's') ADVANCE(66);
      END_STATE();
    case 21:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'l') ADVANCE(67);
      if (lookahead == 'p') ADVANCE(68);
      if (lookahead == 'q') ADVANCE(69);
      if (lookahead == 't') ADVANCE(70);
      END_STATE();
    case 22:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'h') ADVANCE(71);
      if (lookahead == 'i') ADVANCE(72);
      if (lookahead == 'o') ADVANCE(73);
      if (lookahead == 'r') ADVANCE(74);
      END_STATE();
    case 23:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'p') ADVANCE(75);
      END_STATE();
    case 24:
      ACCEPT_TOKEN(sym_variable);
      if (lookahead == 'a') ADVANCE(76);
      if (lookahead == 'p') ADVANCE(77);
      END_STATE();
    case 25:
      ACCEPT_TOKEN(sym_variable);
      END_STATE();
    case 26:
      if (lookahead == 'D') ADVANCE(78);
      END_STATE();
    case 27:
      if (lookahead == 'n') ADVANCE(79);
      END_STATE();
    case 28:
      if (lookahead == 'h') ADVANCE(80);
      if (lookahead == 'w') ADVANCE(81);
      END_STATE();
    case 29:
      if (lookahead == 'e') ADVANCE(82);
      END_STATE();
    case 30:
      if (lookahead == 'B') ADVANCE(83);
      END_STATE();
    case 31:
      if (lookahead == 'a') ADVANCE(84);
      END_STATE();
    case 32:
      if (lookahead == 'a') ADVANCE(85);
      END_STATE();
    case 33:
      if (lookahead == 's') ADVANCE(86);
      END_STATE();
    case 34:
      if (lookahead == 'c') ADVANCE(87);
      END_STATE();
    case 35:
      if (lookahead == 'd') ADVANCE(88);
      END_STATE();
    case 36:
      if (lookahead == 'c') ADVANCE(89);
      if (lookahead == 's') ADVANCE(90);
      END_STATE();
    case 37:
      if (lookahead == 'u') ADVANCE(91);
      END_STATE();
    case 38:
      if (lookahead == 'd') ADVANCE(92);
      END_STATE();
    case 39:
      if (lookahead == 'r') ADVANCE(93);
      END_STATE();
    case 40:
      if (lookahead == 't') ADVANCE(94);
      END_STATE();
    case 41:
      if (lookahead == 'l') ADVANCE(95);
      END_STATE();
    case 42:
      if (lookahead == 'h') ADVANCE(96);
      END_STATE();
    case 43:
      if (lookahead == 's') ADVANCE(97);
      END_STATE();
    case 44:
      if (lookahead == 'd') ADVANCE(98);
      END_STATE();
    case 45:
      if (lookahead == 'r') ADVANCE(99);
      END_STATE();
    case 46:
      if (lookahead == 'r') ADVANCE(100);
      if (lookahead == 's') ADVANCE(101);
      if (lookahead == 't') ADVANCE(102);
      END_STATE();
    case 47:
      if (lookahead == 'n') ADVANCE(103);
      END_STATE();
    case 48:
      if (lookahead == 'r') ADVANCE(104);
      END_STATE();
    case 49:
      if (lookahead == 'g') ADVANCE(105);
      END_STATE();
    case 50:
      if (lookahead == 'a') ADVANCE(106);
      END_STATE();
    case 51:
      ACCEPT_TOKEN(anon_sym_if);
      END_STATE();
    case 52:
      if (lookahead == 'p') ADVANCE(107);
      END_STATE();
    case 53:
      if (lookahead == 'c') ADVANCE(108);
      END_STATE();
    case 54:
      if (lookahead == 't') ADVANCE(109);
      END_STATE();
    case 55:
      if (lookahead == 'c') ADVANCE(110);
      END_STATE();
    case 56:
      if (lookahead == 'c') ADVANCE(111);
      END_STATE();
    case 57:
      if (lookahead == 'x') ADVANCE(112);
      END_STATE();
    case 58:
      ACCEPT_TOKEN(anon_sym_on);
      END_STATE();
    case 59:
      ACCEPT_TOKEN(anon_sym_or);
      END_STATE();
    case 60:
      if (lookahead == 't') ADVANCE(113);
      END_STATE();
    case 61:
      if (lookahead == 'i') ADVANCE(114);
      END_STATE();
    case 62:
      if (lookahead == 'n') ADVANCE(115);
      if (lookahead == 'w') ADVANCE(83);
      END_STATE();
    case 63:
      if (lookahead == 'a') ADVANCE(116);
      if (lookahead == 'd') ADVANCE(117);
      if (lookahead == 's') ADVANCE(118);
      if (lookahead == 't') ADVANCE(119);
      END_STATE();
    case 64:
      if (lookahead == 'd') ADVANCE(86);
      END_STATE();
    case 65:
      if (lookahead == 'l') ADVANCE(120);
      END_STATE();
    case 66:
      if (lookahead == 't') ADVANCE(121);
      END_STATE();
    case 67:
      if (lookahead == 'e') ADVANCE(122);
      END_STATE();
    case 68:
      if (lookahead == 'd') ADVANCE(123);
      if (lookahead == 'e') ADVANCE(124);
      END_STATE();
    case 69:
      if (lookahead == 'r') ADVANCE(125);
      END_STATE();
    case 70:
      if (lookahead == 'e') ADVANCE(126);
      END_STATE();
    case 71:
      if (lookahead == 'e') ADVANCE(127);
      END_STATE();
    case 72:
      if (lookahead == 'm') ADVANCE(128);
      END_STATE();
    case 73:
      ACCEPT_TOKEN(anon_sym_to);
      END_STATE();
    case 74:
      if (lookahead == 'o') ADVANCE(129);
      END_STATE();
    case 75:
      if (lookahead == 'o') ADVANCE(130);
      END_STATE();
    case 76:
      if (lookahead == 'w') ADVANCE(131);
      END_STATE();
    case 77:
      if (lookahead == 'o') ADVANCE(132);
      END_STATE();
    case 78:
      if (lookahead == 'C') ADVANCE(83);
      END_STATE();
    case 79:
      if (lookahead == 'e') ADVANCE(131);
      END_STATE();
    case 80:
      if (lookahead == 'r') ADVANCE(133);
      END_STATE();
    case 81:
      if (lookahead == 'o') ADVANCE(131);
      END_STATE();
    case 82:
      if (lookahead == 'r') ADVANCE(134);
      END_STATE();
    case 83:
      ACCEPT_TOKEN(sym_action_word);
      END_STATE();
    case 84:
      if (lookahead == 't') ADVANCE(135);
      END_STATE();
    case 85:
      if (lookahead == 't') ADVANCE(136);
      END_STATE();
    case 86:
      ACCEPT_TOKEN(sym_function_word);
      END_STATE();
    case 87:
      if (lookahead == 'e') ADVANCE(137);
      END_STATE();
    case 88:
      ACCEPT_TOKEN(anon_sym_and);
      END_STATE();
    case 89:
      if (lookahead == 'k') ADVANCE(138);
      END_STATE();
    case 90:
      if (lookahead == 'f') ADVANCE(139);
      END_STATE();
    case 91:
      if (lookahead == 'v') ADVANCE(140);
      END_STATE();
    case 92:
      if (lookahead == 'r') ADVANCE(141);
      if (lookahead == 'v') ADVANCE(142);
      END_STATE();
    case 93:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 94:
      if (lookahead == 'a') ADVANCE(83);
      END_STATE();
    case 95:
      if (lookahead == 'a') ADVANCE(143);
      END_STATE();
    case 96:
      if (lookahead == 'a') ADVANCE(144);
      END_STATE();
    case 97:
      if (lookahead == 'e') ADVANCE(145);
      END_STATE();
    case 98:
      ACCEPT_TOKEN(sym_control_word);
      END_STATE();
    case 99:
      ACCEPT_TOKEN(anon_sym_for);
      END_STATE();
    case 100:
      if (lookahead == 'o') ADVANCE(146);
      END_STATE();
    case 101:
      if (lookahead == 'u') ADVANCE(147);
      END_STATE();
    case 102:
      if (lookahead == 'o') ADVANCE(148);
      END_STATE();
    case 103:
      if (lookahead == 'v') ADVANCE(149);
      END_STATE();
    case 104:
      if (lookahead == 'o') ADVANCE(150);
      END_STATE();
    case 105:
      if (lookahead == 'v') ADVANCE(151);
      END_STATE();
    case 106:
      if (lookahead == 'd') ADVANCE(152);
      END_STATE();
    case 107:
      if (lookahead == 'u') ADVANCE(153);
      END_STATE();
    case 108:
      if (lookahead == 'o') ADVANCE(154);
      END_STATE();
    case 109:
      ACCEPT_TOKEN(anon_sym_let);
      END_STATE();
    case 110:
      if (lookahead == 'a') ADVANCE(155);
      END_STATE();
    case 111:
      if (lookahead == 'k') ADVANCE(156);
      if (lookahead == 'r') ADVANCE(157);
      if (lookahead == 's') ADVANCE(158);
      END_STATE();
    case 112:
      if (lookahead == 't') ADVANCE(159);
      END_STATE();
    case 113:
      if (lookahead == 'c') ADVANCE(160);
      END_STATE();
    case 114:
      if (lookahead == 'n') ADVANCE(161);
      END_STATE();
    case 115:
      if (lookahead == 'd') ADVANCE(162);
      END_STATE();
    case 116:
      if (lookahead == 'd') ADVANCE(83);
      END_STATE();
    case 117:
      if (lookahead == 'v') ADVANCE(163);
      END_STATE();
    case 118:
      if (lookahead == 'e') ADVANCE(164);
      END_STATE();
    case 119:
      if (lookahead == 'u') ADVANCE(165);
      END_STATE();
    case 120:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 121:
      if (lookahead == 'r') ADVANCE(83);
      END_STATE();
    case 122:
      if (lookahead == 'e') ADVANCE(166);
      END_STATE();
    case 123:
      if (lookahead == 'v') ADVANCE(167);
      END_STATE();
    case 124:
      if (lookahead == 'e') ADVANCE(168);
      END_STATE();
    case 125:
      if (lookahead == 't') ADVANCE(86);
      END_STATE();
    case 126:
      if (lookahead == 'p') ADVANCE(169);
      END_STATE();
    case 127:
      if (lookahead == 'n') ADVANCE(170);
      END_STATE();
    case 128:
      if (lookahead == 'e') ADVANCE(171);
      END_STATE();
    case 129:
      if (lookahead == 'f') ADVANCE(172);
      if (lookahead == 'n') ADVANCE(83);
      END_STATE();
    case 130:
      if (lookahead == 's') ADVANCE(131);
      END_STATE();
    case 131:
      ACCEPT_TOKEN(sym_system_variable);
      END_STATE();
    case 132:
      if (lookahead == 's') ADVANCE(131);
      END_STATE();
    case 133:
      if (lookahead == 'e') ADVANCE(173);
      END_STATE();
    case 134:
      if (lookahead == 'o') ADVANCE(131);
      END_STATE();
    case 135:
      if (lookahead == 't') ADVANCE(131);
      END_STATE();
    case 136:
      if (lookahead == 't') ADVANCE(131);
      END_STATE();
    case 137:
      if (lookahead == 'l') ADVANCE(174);
      END_STATE();
    case 138:
      if (lookahead == 'L') ADVANCE(175);
      END_STATE();
    case 139:
      if (lookahead == 'l') ADVANCE(176);
      END_STATE();
    case 140:
      if (lookahead == 'a') ADVANCE(177);
      END_STATE();
    case 141:
      if (lookahead == 'g') ADVANCE(178);
      if (lookahead == 'o') ADVANCE(179);
      END_STATE();
    case 142:
      if (lookahead == 'a') ADVANCE(180);
      END_STATE();
    case 143:
      if (lookahead == 'y') ADVANCE(83);
      END_STATE();
    case 144:
      if (lookahead == 'k') ADVANCE(181);
      END_STATE();
    case 145:
      ACCEPT_TOKEN(anon_sym_else);
      END_STATE();
    case 146:
      if (lookahead == 'l') ADVANCE(182);
      END_STATE();
    case 147:
      if (lookahead == 'b') ADVANCE(183);
      END_STATE();
    case 148:
      ACCEPT_TOKEN(anon_sym_goto);
      END_STATE();
    case 149:
      if (lookahead == 'a') ADVANCE(184);
      END_STATE();
    case 150:
      if (('X' <= lookahead && lookahead <= 'Z')) ADVANCE(131);
      END_STATE();
    case 151:
      if (lookahead == 'a') ADVANCE(185);
      END_STATE();
    case 152:
      if (lookahead == 'i') ADVANCE(186);
      END_STATE();
    case 153:
      if (lookahead == 't') ADVANCE(83);
      END_STATE();
    case 154:
      if (lookahead == 'n') ADVANCE(187);
      END_STATE();
    case 155:
      if (lookahead == 't') ADVANCE(188);
      END_STATE();
    case 156:
      if (lookahead == 'i') ADVANCE(189);
      END_STATE();
    case 157:
      if (lookahead == 'u') ADVANCE(190);
      END_STATE();
    case 158:
      if (lookahead == 't') ADVANCE(191);
      END_STATE();
    case 159:
      ACCEPT_TOKEN(anon_sym_next);
      END_STATE();
    case 160:
      if (lookahead == 'h') ADVANCE(131);
      END_STATE();
    case 161:
      if (lookahead == 't') ADVANCE(192);
      END_STATE();
    case 162:
      if (lookahead == 'o') ADVANCE(193);
      END_STATE();
    case 163:
      if (lookahead == 'a') ADVANCE(194);
      END_STATE();
    case 164:
      if (lookahead == 't') ADVANCE(83);
      END_STATE();
    case 165:
      if (lookahead == 'r') ADVANCE(195);
      END_STATE();
    case 166:
      if (lookahead == 'p') ADVANCE(83);
      END_STATE();
    case 167:
      if (lookahead == 'a') ADVANCE(196);
      END_STATE();
    case 168:
      if (lookahead == 'd') ADVANCE(131);
      END_STATE();
    case 169:
      ACCEPT_TOKEN(anon_sym_step);
      END_STATE();
    case 170:
      ACCEPT_TOKEN(anon_sym_then);
      END_STATE();
    case 171:
      if (lookahead == 'r') ADVANCE(197);
      END_STATE();
    case 172:
      if (lookahead == 'f') ADVANCE(83);
      END_STATE();
    case 173:
      if (lookahead == 'e') ADVANCE(131);
      END_STATE();
    case 174:
      if (lookahead == 'o') ADVANCE(198);
      if (('X' <= lookahead && lookahead <= 'Z')) ADVANCE(131);
      END_STATE();
    case 175:
      if (lookahead == 'E') ADVANCE(199);
      END_STATE();
    case 176:
      if (lookahead == 'g') ADVANCE(83);
      END_STATE();
    case 177:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 178:
      if (lookahead == 'b') ADVANCE(131);
      END_STATE();
    case 179:
      if (lookahead == 'l') ADVANCE(200);
      END_STATE();
    case 180:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 181:
      if (lookahead == 'e') ADVANCE(131);
      END_STATE();
    case 182:
      if (lookahead == 'l') ADVANCE(83);
      END_STATE();
    case 183:
      ACCEPT_TOKEN(anon_sym_gosub);
      END_STATE();
    case 184:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 185:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 186:
      if (lookahead == 'n') ADVANCE(201);
      END_STATE();
    case 187:
      if (lookahead == 'n') ADVANCE(131);
      END_STATE();
    case 188:
      if (lookahead == 'e') ADVANCE(83);
      END_STATE();
    case 189:
      if (lookahead == 'l') ADVANCE(202);
      END_STATE();
    case 190:
      if (lookahead == 'n') ADVANCE(83);
      END_STATE();
    case 191:
      if (lookahead == 'a') ADVANCE(203);
      END_STATE();
    case 192:
      ACCEPT_TOKEN(anon_sym_print);
      END_STATE();
    case 193:
      if (lookahead == 'm') ADVANCE(83);
      END_STATE();
    case 194:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 195:
      if (lookahead == 'n') ADVANCE(98);
      END_STATE();
    case 196:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 197:
      if (('A' <= lookahead && lookahead <= 'C')) ADVANCE(131);
      END_STATE();
    case 198:
      if (lookahead == 'n') ADVANCE(204);
      END_STATE();
    case 199:
      if (lookahead == 'D') ADVANCE(83);
      END_STATE();
    case 200:
      if (lookahead == 'l') ADVANCE(131);
      END_STATE();
    case 201:
      if (lookahead == 'g') ADVANCE(83);
      END_STATE();
    case 202:
      if (lookahead == 'l') ADVANCE(83);
      END_STATE();
    case 203:
      if (lookahead == 't') ADVANCE(131);
      END_STATE();
    case 204:
      if (lookahead == 'e') ADVANCE(131);
      END_STATE();
    default:
      return false;
  }
}

static const TSLexMode ts_lex_modes[STATE_COUNT] = {
  [0] = {.lex_state = 0},
  [1] = {.lex_state = 0},
  [2] = {.lex_state = 0},
  [3] = {.lex_state = 0},
  [4] = {.lex_state = 0},
  [5] = {.lex_state = 0},
  [6] = {.lex_state = 0},
  [7] = {.lex_state = 0},
  [8] = {.lex_state = 0},
  [9] = {.lex_state = 0},
  [10] = {.lex_state = 0},
  [11] = {.lex_state = 0},
  [12] = {.lex_state = 0},
  [13] = {.lex_state = 0},
  [14] = {.lex_state = 3},
  [15] = {.lex_state = 3},
  [16] = {.lex_state = 3},
  [17] = {.lex_state = 3},
  [18] = {.lex_state = 3},
  [19] = {.lex_state = 3},
  [20] = {.lex_state = 0},
  [21] = {.lex_state = 0},
  [22] = {.lex_state = 0},
  [23] = {.lex_state = 0},
  [24] = {.lex_state = 0},
  [25] = {.lex_state = 0},
  [26] = {.lex_state = 0},
  [27] = {.lex_state = 0},
  [28] = {.lex_state = 0},
  [29] = {.lex_state = 0},
  [30] = {.lex_state = 0},
  [31] = {.lex_state = 0},
  [32] = {.lex_state = 0},
  [33] = {.lex_state = 0},
  [34] = {.lex_state = 0},
  [35] = {.lex_state = 0},
  [36] = {.lex_state = 0},
  [37] = {.lex_state = 0},
  [38] = {.lex_state = 0},
  [39] = {.lex_state = 0},
  [40] = {.lex_state = 0},
  [41] = {.lex_state = 0},
  [42] = {.lex_state = 0},
  [43] = {.lex_state = 0},
  [44] = {.lex_state = 0},
  [45] = {.lex_state = 0},
  [46] = {.lex_state = 0},
  [47] = {.lex_state = 0},
  [48] = {.lex_state = 0},
  [49] = {.lex_state = 0},
  [50] = {.lex_state = 0},
  [51] = {.lex_state = 0},
  [52] = {.lex_state = 0},
  [53] = {.lex_state = 0},
  [54] = {.lex_state = 0},
  [55] = {.lex_state = 0},
  [56] = {.lex_state = 0},
  [57] = {.lex_state = 0},
  [58] = {.lex_state = 0},
  [59] = {.lex_state = 0},
  [60] = {.lex_state = 0},
  [61] = {.lex_state = 0},
  [62] = {.lex_state = 0},
  [63] = {.lex_state = 0},
  [64] = {.lex_state = 0},
  [65] = {.lex_state = 0},
  [66] = {.lex_state = 0},
  [67] = {.lex_state = 0},
  [68] = {.lex_state = 0},
  [69] = {.lex_state = 0},
  [70] = {.lex_state = 0},
  [71] = {.lex_state = 0},
  [72] = {.lex_state = 0},
  [73] = {.lex_state = 0},
  [74] = {.lex_state = 0},
  [75] = {.lex_state = 0},
  [76] = {.lex_state = 0},
  [77] = {.lex_state = 0},
  [78] = {.lex_state = 0},
  [79] = {.lex_state = 0},
  [80] = {.lex_state = 0},
  [81] = {.lex_state = 0},
  [82] = {.lex_state = 0},
  [83] = {.lex_state = 0},
  [84] = {.lex_state = 0},
  [85] = {.lex_state = 0},
  [86] = {.lex_state = 3},
  [87] = {.lex_state = 0},
  [88] = {.lex_state = 0},
  [89] = {.lex_state = 0},
  [90] = {.lex_state = 0},
  [91] = {.lex_state = 0},
  [92] = {.lex_state = 0},
  [93] = {.lex_state = 0},
  [94] = {.lex_state = 0},
  [95] = {.lex_state = 0},
  [96] = {.lex_state = 0},
  [97] = {.lex_state = 0},
  [98] = {.lex_state = 0},
  [99] = {.lex_state = 0},
  [100] = {.lex_state = 0},
  [101] = {.lex_state = 0},
  [102] = {.lex_state = 0},
  [103] = {.lex_state = 0},
  [104] = {.lex_state = 0},
  [105] = {.lex_state = 0},
  [106] = {.lex_state = 0},
  [107] = {.lex_state = 0},
  [108] = {.lex_state = 0},
  [109] = {.lex_state = 0},
  [110] = {.lex_state = 0},
  [111] = {.lex_state = 2},
  [112] = {.lex_state = 2},
  [113] = {.lex_state = 2},
  [114] = {.lex_state = 0},
};

static const uint16_t ts_parse_table[LARGE_STATE_COUNT][SYMBOL_COUNT] = {
  [0] = {
    [ts_builtin_sym_end] = ACTIONS(1),
    [sym__word] = ACTIONS(1),
    [aux_sym_program_token1] = ACTIONS(1),
    [aux_sym_line_number_token1] = ACTIONS(1),
    [sym__line_end] = ACTIONS(1),
    [anon_sym_let] = ACTIONS(1),
    [anon_sym_EQ] = ACTIONS(1),
    [anon_sym_if] = ACTIONS(1),
    [anon_sym_and] = ACTIONS(1),
    [anon_sym_or] = ACTIONS(1),
    [anon_sym_then] = ACTIONS(1),
    [anon_sym_else] = ACTIONS(1),
    [aux_sym_relation_token1] = ACTIONS(1),
    [anon_sym_for] = ACTIONS(1),
    [anon_sym_to] = ACTIONS(1),
    [anon_sym_step] = ACTIONS(1),
    [anon_sym_next] = ACTIONS(1),
    [anon_sym_goto] = ACTIONS(1),
    [anon_sym_gosub] = ACTIONS(1),
    [anon_sym_on] = ACTIONS(1),
    [anon_sym_COMMA] = ACTIONS(1),
    [anon_sym_print] = ACTIONS(1),
    [anon_sym_QMARK] = ACTIONS(1),
    [anon_sym_SEMI] = ACTIONS(1),
    [anon_sym_DOLLAR] = ACTIONS(1),
    [sym_action_word] = ACTIONS(1),
    [sym_control_word] = ACTIONS(1),
    [anon_sym_LPAREN] = ACTIONS(1),
    [anon_sym_RPAREN] = ACTIONS(1),
    [anon_sym_DASH] = ACTIONS(1),
    [aux_sym_product_token1] = ACTIONS(1),
    [aux_sym_sum_token1] = ACTIONS(1),
    [sym_function_word] = ACTIONS(1),
    [sym_system_variable] = ACTIONS(1),
    [sym_variable] = ACTIONS(1),
    [sym_string] = ACTIONS(1),
    [sym_comment] = ACTIONS(1),
  },
  [1] = {
    [sym_program] = STATE(110),
    [sym__content] = STATE(104),
    [sym_line] = STATE(94),
    [sym_line_number] = STATE(2),
    [aux_sym_program_repeat1] = STATE(70),
    [ts_builtin_sym_end] = ACTIONS(3),
    [aux_sym_program_token1] = ACTIONS(5),
    [aux_sym_line_number_token1] = ACTIONS(7),
    [sym__line_end] = ACTIONS(9),
    [sym_comment] = ACTIONS(11),
  },
};

static const uint16_t ts_small_parse_table[] = {
  [0] = 12,
    ACTIONS(15), 1,
      anon_sym_let,
    ACTIONS(17), 1,
      anon_sym_if,
    ACTIONS(19), 1,
      anon_sym_for,
    ACTIONS(21), 1,
      anon_sym_next,
    ACTIONS(25), 1,
      anon_sym_on,
    ACTIONS(31), 1,
      sym_system_variable,
    ACTIONS(33), 1,
      sym_variable,
    ACTIONS(23), 2,
      anon_sym_goto,
      anon_sym_gosub,
    ACTIONS(27), 2,
      anon_sym_print,
      anon_sym_QMARK,
    ACTIONS(29), 2,
      sym_action_word,
      sym_control_word,
    ACTIONS(13), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
    STATE(99), 10,
      sym__statement,
      sym__in_branch,
      sym_assignment,
      sym_conditional,
      sym_loop,
      sym_loop_end,
      sym_jump,
      sym_indexed_jump,
      sym_output,
      sym_action,
  [51] = 11,
    ACTIONS(37), 1,
      aux_sym_line_number_token1,
    ACTIONS(41), 1,
      anon_sym_DOLLAR,
    ACTIONS(43), 1,
      anon_sym_LPAREN,
    ACTIONS(45), 1,
      anon_sym_DASH,
    ACTIONS(47), 1,
      sym_function_word,
    ACTIONS(49), 1,
      sym_system_variable,
    ACTIONS(51), 1,
      sym_variable,
    STATE(5), 1,
      aux_sym_output_repeat1,
    ACTIONS(39), 3,
      anon_sym_COMMA,
      anon_sym_SEMI,
      sym_string,
    ACTIONS(35), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
    STATE(22), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [96] = 11,
    ACTIONS(55), 1,
      aux_sym_line_number_token1,
    ACTIONS(61), 1,
      anon_sym_DOLLAR,
    ACTIONS(64), 1,
      anon_sym_LPAREN,
    ACTIONS(67), 1,
      anon_sym_DASH,
    ACTIONS(70), 1,
      sym_function_word,
    ACTIONS(73), 1,
      sym_system_variable,
    ACTIONS(76), 1,
      sym_variable,
    STATE(4), 1,
      aux_sym_output_repeat1,
    ACTIONS(58), 3,
      anon_sym_COMMA,
      anon_sym_SEMI,
      sym_string,
    ACTIONS(53), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
    STATE(22), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [141] = 11,
    ACTIONS(37), 1,
      aux_sym_line_number_token1,
    ACTIONS(41), 1,
      anon_sym_DOLLAR,
    ACTIONS(43), 1,
      anon_sym_LPAREN,
    ACTIONS(45), 1,
      anon_sym_DASH,
    ACTIONS(47), 1,
      sym_function_word,
    ACTIONS(49), 1,
      sym_system_variable,
    ACTIONS(51), 1,
      sym_variable,
    STATE(4), 1,
      aux_sym_output_repeat1,
    ACTIONS(81), 3,
      anon_sym_COMMA,
      anon_sym_SEMI,
      sym_string,
    ACTIONS(79), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
    STATE(22), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [186] = 11,
    ACTIONS(83), 1,
      aux_sym_line_number_token1,
    ACTIONS(87), 1,
      anon_sym_DOLLAR,
    ACTIONS(89), 1,
      anon_sym_LPAREN,
    ACTIONS(91), 1,
      anon_sym_DASH,
    ACTIONS(93), 1,
      sym_function_word,
    ACTIONS(95), 1,
      sym_system_variable,
    ACTIONS(97), 1,
      sym_variable,
    STATE(8), 1,
      aux_sym_output_repeat1,
    ACTIONS(79), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
    ACTIONS(85), 3,
      anon_sym_COMMA,
      anon_sym_SEMI,
      sym_string,
    STATE(31), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [230] = 11,
    ACTIONS(83), 1,
      aux_sym_line_number_token1,
    ACTIONS(87), 1,
      anon_sym_DOLLAR,
    ACTIONS(89), 1,
      anon_sym_LPAREN,
    ACTIONS(91), 1,
      anon_sym_DASH,
    ACTIONS(93), 1,
      sym_function_word,
    ACTIONS(95), 1,
      sym_system_variable,
    ACTIONS(97), 1,
      sym_variable,
    STATE(6), 1,
      aux_sym_output_repeat1,
    ACTIONS(35), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
    ACTIONS(99), 3,
      anon_sym_COMMA,
      anon_sym_SEMI,
      sym_string,
    STATE(31), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [274] = 11,
    ACTIONS(101), 1,
      aux_sym_line_number_token1,
    ACTIONS(107), 1,
      anon_sym_DOLLAR,
    ACTIONS(110), 1,
      anon_sym_LPAREN,
    ACTIONS(113), 1,
      anon_sym_DASH,
    ACTIONS(116), 1,
      sym_function_word,
    ACTIONS(119), 1,
      sym_system_variable,
    ACTIONS(122), 1,
      sym_variable,
    STATE(8), 1,
      aux_sym_output_repeat1,
    ACTIONS(53), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
    ACTIONS(104), 3,
      anon_sym_COMMA,
      anon_sym_SEMI,
      sym_string,
    STATE(31), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [318] = 10,
    ACTIONS(15), 1,
      anon_sym_let,
    ACTIONS(19), 1,
      anon_sym_for,
    ACTIONS(21), 1,
      anon_sym_next,
    ACTIONS(25), 1,
      anon_sym_on,
    ACTIONS(31), 1,
      sym_system_variable,
    ACTIONS(33), 1,
      sym_variable,
    ACTIONS(23), 2,
      anon_sym_goto,
      anon_sym_gosub,
    ACTIONS(27), 2,
      anon_sym_print,
      anon_sym_QMARK,
    ACTIONS(29), 2,
      sym_action_word,
      sym_control_word,
    STATE(101), 8,
      sym__in_branch,
      sym_assignment,
      sym_loop,
      sym_loop_end,
      sym_jump,
      sym_indexed_jump,
      sym_output,
      sym_action,
  [359] = 10,
    ACTIONS(15), 1,
      anon_sym_let,
    ACTIONS(19), 1,
      anon_sym_for,
    ACTIONS(21), 1,
      anon_sym_next,
    ACTIONS(25), 1,
      anon_sym_on,
    ACTIONS(31), 1,
      sym_system_variable,
    ACTIONS(33), 1,
      sym_variable,
    ACTIONS(23), 2,
      anon_sym_goto,
      anon_sym_gosub,
    ACTIONS(125), 2,
      anon_sym_print,
      anon_sym_QMARK,
    ACTIONS(127), 2,
      sym_action_word,
      sym_control_word,
    STATE(92), 8,
      sym__in_branch,
      sym_assignment,
      sym_loop,
      sym_loop_end,
      sym_jump,
      sym_indexed_jump,
      sym_output,
      sym_action,
  [400] = 10,
    ACTIONS(15), 1,
      anon_sym_let,
    ACTIONS(19), 1,
      anon_sym_for,
    ACTIONS(21), 1,
      anon_sym_next,
    ACTIONS(25), 1,
      anon_sym_on,
    ACTIONS(31), 1,
      sym_system_variable,
    ACTIONS(33), 1,
      sym_variable,
    ACTIONS(23), 2,
      anon_sym_goto,
      anon_sym_gosub,
    ACTIONS(125), 2,
      anon_sym_print,
      anon_sym_QMARK,
    ACTIONS(127), 2,
      sym_action_word,
      sym_control_word,
    STATE(90), 8,
      sym__in_branch,
      sym_assignment,
      sym_loop,
      sym_loop_end,
      sym_jump,
      sym_indexed_jump,
      sym_output,
      sym_action,
  [441] = 10,
    ACTIONS(15), 1,
      anon_sym_let,
    ACTIONS(19), 1,
      anon_sym_for,
    ACTIONS(21), 1,
      anon_sym_next,
    ACTIONS(25), 1,
      anon_sym_on,
    ACTIONS(31), 1,
      sym_system_variable,
    ACTIONS(33), 1,
      sym_variable,
    ACTIONS(23), 2,
      anon_sym_goto,
      anon_sym_gosub,
    ACTIONS(27), 2,
      anon_sym_print,
      anon_sym_QMARK,
    ACTIONS(29), 2,
      sym_action_word,
      sym_control_word,
    STATE(98), 8,
      sym__in_branch,
      sym_assignment,
      sym_loop,
      sym_loop_end,
      sym_jump,
      sym_indexed_jump,
      sym_output,
      sym_action,
  [482] = 8,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(139), 1,
      sym_system_variable,
    ACTIONS(141), 1,
      sym_variable,
    ACTIONS(129), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
    STATE(65), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [516] = 1,
    ACTIONS(143), 17,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_and,
      anon_sym_or,
      anon_sym_then,
      anon_sym_else,
      aux_sym_relation_token1,
      anon_sym_to,
      anon_sym_step,
      anon_sym_goto,
      anon_sym_gosub,
      anon_sym_COMMA,
      anon_sym_RPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_comment,
  [536] = 1,
    ACTIONS(145), 17,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_and,
      anon_sym_or,
      anon_sym_then,
      anon_sym_else,
      aux_sym_relation_token1,
      anon_sym_to,
      anon_sym_step,
      anon_sym_goto,
      anon_sym_gosub,
      anon_sym_COMMA,
      anon_sym_RPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_comment,
  [556] = 2,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(147), 16,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_and,
      anon_sym_or,
      anon_sym_then,
      anon_sym_else,
      aux_sym_relation_token1,
      anon_sym_to,
      anon_sym_step,
      anon_sym_goto,
      anon_sym_gosub,
      anon_sym_COMMA,
      anon_sym_RPAREN,
      anon_sym_DASH,
      aux_sym_sum_token1,
      sym_comment,
  [578] = 1,
    ACTIONS(151), 17,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_and,
      anon_sym_or,
      anon_sym_then,
      anon_sym_else,
      aux_sym_relation_token1,
      anon_sym_to,
      anon_sym_step,
      anon_sym_goto,
      anon_sym_gosub,
      anon_sym_COMMA,
      anon_sym_RPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_comment,
  [598] = 1,
    ACTIONS(153), 17,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_and,
      anon_sym_or,
      anon_sym_then,
      anon_sym_else,
      aux_sym_relation_token1,
      anon_sym_to,
      anon_sym_step,
      anon_sym_goto,
      anon_sym_gosub,
      anon_sym_COMMA,
      anon_sym_RPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_comment,
  [618] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(155), 14,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_and,
      anon_sym_or,
      anon_sym_then,
      anon_sym_else,
      aux_sym_relation_token1,
      anon_sym_to,
      anon_sym_step,
      anon_sym_goto,
      anon_sym_gosub,
      anon_sym_COMMA,
      anon_sym_RPAREN,
      sym_comment,
  [642] = 8,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(139), 1,
      sym_system_variable,
    ACTIONS(141), 1,
      sym_variable,
    ACTIONS(129), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
    STATE(65), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [675] = 2,
    ACTIONS(161), 1,
      sym_variable,
    ACTIONS(159), 15,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_let,
      anon_sym_if,
      anon_sym_for,
      anon_sym_next,
      anon_sym_goto,
      anon_sym_gosub,
      anon_sym_on,
      anon_sym_print,
      anon_sym_QMARK,
      sym_action_word,
      sym_control_word,
      sym_system_variable,
      sym_comment,
  [696] = 4,
    ACTIONS(167), 1,
      aux_sym_product_token1,
    ACTIONS(169), 1,
      sym_variable,
    ACTIONS(165), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(163), 12,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [721] = 4,
    ACTIONS(167), 1,
      aux_sym_product_token1,
    ACTIONS(171), 1,
      sym_variable,
    ACTIONS(165), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(155), 12,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [746] = 4,
    ACTIONS(167), 1,
      aux_sym_product_token1,
    ACTIONS(173), 1,
      sym_variable,
    ACTIONS(165), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(53), 12,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [771] = 2,
    ACTIONS(175), 1,
      sym_variable,
    ACTIONS(145), 15,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [792] = 2,
    ACTIONS(177), 1,
      sym_variable,
    ACTIONS(153), 15,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [813] = 2,
    ACTIONS(179), 1,
      sym_variable,
    ACTIONS(151), 15,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [834] = 3,
    ACTIONS(167), 1,
      aux_sym_product_token1,
    ACTIONS(181), 1,
      sym_variable,
    ACTIONS(147), 14,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [857] = 2,
    ACTIONS(183), 1,
      sym_variable,
    ACTIONS(143), 15,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [878] = 4,
    ACTIONS(173), 1,
      sym_variable,
    ACTIONS(187), 1,
      aux_sym_product_token1,
    ACTIONS(185), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(53), 11,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [902] = 4,
    ACTIONS(169), 1,
      sym_variable,
    ACTIONS(187), 1,
      aux_sym_product_token1,
    ACTIONS(185), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(163), 11,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [926] = 2,
    ACTIONS(179), 1,
      sym_variable,
    ACTIONS(151), 14,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [946] = 2,
    ACTIONS(183), 1,
      sym_variable,
    ACTIONS(143), 14,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [966] = 3,
    ACTIONS(181), 1,
      sym_variable,
    ACTIONS(187), 1,
      aux_sym_product_token1,
    ACTIONS(147), 13,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [988] = 4,
    ACTIONS(171), 1,
      sym_variable,
    ACTIONS(187), 1,
      aux_sym_product_token1,
    ACTIONS(185), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(155), 11,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [1012] = 2,
    ACTIONS(177), 1,
      sym_variable,
    ACTIONS(153), 14,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [1032] = 2,
    ACTIONS(175), 1,
      sym_variable,
    ACTIONS(145), 14,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      anon_sym_COMMA,
      anon_sym_SEMI,
      anon_sym_DOLLAR,
      anon_sym_LPAREN,
      anon_sym_DASH,
      aux_sym_product_token1,
      aux_sym_sum_token1,
      sym_function_word,
      sym_system_variable,
      sym_string,
      sym_comment,
  [1052] = 8,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(189), 1,
      sym_system_variable,
    ACTIONS(191), 1,
      sym_variable,
    STATE(109), 1,
      sym_relation,
    STATE(86), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1083] = 8,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(189), 1,
      sym_system_variable,
    ACTIONS(191), 1,
      sym_variable,
    STATE(97), 1,
      sym_relation,
    STATE(86), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1114] = 7,
    ACTIONS(37), 1,
      aux_sym_line_number_token1,
    ACTIONS(43), 1,
      anon_sym_LPAREN,
    ACTIONS(45), 1,
      anon_sym_DASH,
    ACTIONS(47), 1,
      sym_function_word,
    ACTIONS(193), 1,
      sym_system_variable,
    ACTIONS(195), 1,
      sym_variable,
    STATE(28), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1142] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(197), 1,
      sym_system_variable,
    ACTIONS(199), 1,
      sym_variable,
    STATE(91), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1170] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(201), 1,
      sym_system_variable,
    ACTIONS(203), 1,
      sym_variable,
    STATE(73), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1198] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(205), 1,
      sym_system_variable,
    ACTIONS(207), 1,
      sym_variable,
    STATE(74), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1226] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(209), 1,
      sym_system_variable,
    ACTIONS(211), 1,
      sym_variable,
    STATE(79), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1254] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(213), 1,
      sym_system_variable,
    ACTIONS(215), 1,
      sym_variable,
    STATE(16), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1282] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(217), 1,
      sym_system_variable,
    ACTIONS(219), 1,
      sym_variable,
    STATE(14), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1310] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(221), 1,
      sym_system_variable,
    ACTIONS(223), 1,
      sym_variable,
    STATE(93), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1338] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(225), 1,
      sym_system_variable,
    ACTIONS(227), 1,
      sym_variable,
    STATE(71), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1366] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(229), 1,
      sym_system_variable,
    ACTIONS(231), 1,
      sym_variable,
    STATE(83), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1394] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(233), 1,
      sym_system_variable,
    ACTIONS(235), 1,
      sym_variable,
    STATE(69), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1422] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(237), 1,
      sym_system_variable,
    ACTIONS(239), 1,
      sym_variable,
    STATE(72), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1450] = 7,
    ACTIONS(83), 1,
      aux_sym_line_number_token1,
    ACTIONS(89), 1,
      anon_sym_LPAREN,
    ACTIONS(91), 1,
      anon_sym_DASH,
    ACTIONS(93), 1,
      sym_function_word,
    ACTIONS(241), 1,
      sym_system_variable,
    ACTIONS(243), 1,
      sym_variable,
    STATE(36), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1478] = 7,
    ACTIONS(83), 1,
      aux_sym_line_number_token1,
    ACTIONS(89), 1,
      anon_sym_LPAREN,
    ACTIONS(91), 1,
      anon_sym_DASH,
    ACTIONS(93), 1,
      sym_function_word,
    ACTIONS(245), 1,
      sym_system_variable,
    ACTIONS(247), 1,
      sym_variable,
    STATE(35), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1506] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(249), 1,
      sym_system_variable,
    ACTIONS(251), 1,
      sym_variable,
    STATE(85), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1534] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(253), 1,
      sym_system_variable,
    ACTIONS(255), 1,
      sym_variable,
    STATE(18), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1562] = 7,
    ACTIONS(83), 1,
      aux_sym_line_number_token1,
    ACTIONS(89), 1,
      anon_sym_LPAREN,
    ACTIONS(91), 1,
      anon_sym_DASH,
    ACTIONS(93), 1,
      sym_function_word,
    ACTIONS(257), 1,
      sym_system_variable,
    ACTIONS(259), 1,
      sym_variable,
    STATE(34), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1590] = 7,
    ACTIONS(83), 1,
      aux_sym_line_number_token1,
    ACTIONS(89), 1,
      anon_sym_LPAREN,
    ACTIONS(91), 1,
      anon_sym_DASH,
    ACTIONS(93), 1,
      sym_function_word,
    ACTIONS(261), 1,
      sym_system_variable,
    ACTIONS(263), 1,
      sym_variable,
    STATE(33), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1618] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(265), 1,
      sym_system_variable,
    ACTIONS(267), 1,
      sym_variable,
    STATE(19), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1646] = 7,
    ACTIONS(37), 1,
      aux_sym_line_number_token1,
    ACTIONS(43), 1,
      anon_sym_LPAREN,
    ACTIONS(45), 1,
      anon_sym_DASH,
    ACTIONS(47), 1,
      sym_function_word,
    ACTIONS(269), 1,
      sym_system_variable,
    ACTIONS(271), 1,
      sym_variable,
    STATE(26), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1674] = 7,
    ACTIONS(37), 1,
      aux_sym_line_number_token1,
    ACTIONS(43), 1,
      anon_sym_LPAREN,
    ACTIONS(45), 1,
      anon_sym_DASH,
    ACTIONS(47), 1,
      sym_function_word,
    ACTIONS(273), 1,
      sym_system_variable,
    ACTIONS(275), 1,
      sym_variable,
    STATE(23), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1702] = 7,
    ACTIONS(83), 1,
      aux_sym_line_number_token1,
    ACTIONS(89), 1,
      anon_sym_LPAREN,
    ACTIONS(91), 1,
      anon_sym_DASH,
    ACTIONS(93), 1,
      sym_function_word,
    ACTIONS(277), 1,
      sym_system_variable,
    ACTIONS(279), 1,
      sym_variable,
    STATE(30), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1730] = 7,
    ACTIONS(37), 1,
      aux_sym_line_number_token1,
    ACTIONS(43), 1,
      anon_sym_LPAREN,
    ACTIONS(45), 1,
      anon_sym_DASH,
    ACTIONS(47), 1,
      sym_function_word,
    ACTIONS(281), 1,
      sym_system_variable,
    ACTIONS(283), 1,
      sym_variable,
    STATE(29), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1758] = 7,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    ACTIONS(133), 1,
      anon_sym_LPAREN,
    ACTIONS(135), 1,
      anon_sym_DASH,
    ACTIONS(137), 1,
      sym_function_word,
    ACTIONS(285), 1,
      sym_system_variable,
    ACTIONS(287), 1,
      sym_variable,
    STATE(89), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1786] = 7,
    ACTIONS(37), 1,
      aux_sym_line_number_token1,
    ACTIONS(43), 1,
      anon_sym_LPAREN,
    ACTIONS(45), 1,
      anon_sym_DASH,
    ACTIONS(47), 1,
      sym_function_word,
    ACTIONS(289), 1,
      sym_system_variable,
    ACTIONS(291), 1,
      sym_variable,
    STATE(24), 7,
      sym__expression,
      sym_group,
      sym_negation,
      sym_product,
      sym_sum,
      sym_call,
      sym_number,
  [1814] = 5,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(295), 1,
      anon_sym_COMMA,
    STATE(77), 1,
      aux_sym_action_repeat1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(293), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [1834] = 8,
    ACTIONS(7), 1,
      aux_sym_line_number_token1,
    ACTIONS(297), 1,
      ts_builtin_sym_end,
    ACTIONS(299), 1,
      sym__line_end,
    ACTIONS(301), 1,
      sym_comment,
    STATE(2), 1,
      sym_line_number,
    STATE(67), 1,
      aux_sym_program_repeat1,
    STATE(94), 1,
      sym_line,
    STATE(106), 1,
      sym__content,
  [1859] = 8,
    ACTIONS(303), 1,
      ts_builtin_sym_end,
    ACTIONS(305), 1,
      aux_sym_line_number_token1,
    ACTIONS(308), 1,
      sym__line_end,
    ACTIONS(311), 1,
      sym_comment,
    STATE(2), 1,
      sym_line_number,
    STATE(67), 1,
      aux_sym_program_repeat1,
    STATE(94), 1,
      sym_line,
    STATE(114), 1,
      sym__content,
  [1884] = 8,
    ACTIONS(7), 1,
      aux_sym_line_number_token1,
    ACTIONS(314), 1,
      ts_builtin_sym_end,
    ACTIONS(316), 1,
      sym__line_end,
    ACTIONS(318), 1,
      sym_comment,
    STATE(2), 1,
      sym_line_number,
    STATE(66), 1,
      aux_sym_program_repeat1,
    STATE(94), 1,
      sym_line,
    STATE(105), 1,
      sym__content,
  [1909] = 4,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(322), 1,
      anon_sym_step,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(320), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [1926] = 8,
    ACTIONS(7), 1,
      aux_sym_line_number_token1,
    ACTIONS(299), 1,
      sym__line_end,
    ACTIONS(314), 1,
      ts_builtin_sym_end,
    ACTIONS(318), 1,
      sym_comment,
    STATE(2), 1,
      sym_line_number,
    STATE(67), 1,
      aux_sym_program_repeat1,
    STATE(94), 1,
      sym_line,
    STATE(105), 1,
      sym__content,
  [1951] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(324), 5,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      sym_comment,
  [1966] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(326), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [1980] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(328), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [1994] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(330), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2008] = 3,
    ACTIONS(334), 1,
      anon_sym_COMMA,
    STATE(75), 1,
      aux_sym_indexed_jump_repeat1,
    ACTIONS(332), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2021] = 3,
    ACTIONS(337), 1,
      anon_sym_COMMA,
    STATE(76), 1,
      aux_sym_action_repeat1,
    ACTIONS(324), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2034] = 3,
    ACTIONS(295), 1,
      anon_sym_COMMA,
    STATE(76), 1,
      aux_sym_action_repeat1,
    ACTIONS(340), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2047] = 3,
    ACTIONS(344), 1,
      anon_sym_COMMA,
    STATE(75), 1,
      aux_sym_indexed_jump_repeat1,
    ACTIONS(342), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2060] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(346), 3,
      anon_sym_and,
      anon_sym_or,
      anon_sym_then,
  [2073] = 3,
    ACTIONS(344), 1,
      anon_sym_COMMA,
    STATE(78), 1,
      aux_sym_indexed_jump_repeat1,
    ACTIONS(348), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2086] = 1,
    ACTIONS(332), 5,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      sym_comment,
  [2094] = 1,
    ACTIONS(350), 5,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      anon_sym_COMMA,
      sym_comment,
  [2102] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
    ACTIONS(352), 2,
      anon_sym_goto,
      anon_sym_gosub,
  [2114] = 1,
    ACTIONS(303), 4,
      ts_builtin_sym_end,
      aux_sym_line_number_token1,
      sym__line_end,
      sym_comment,
  [2121] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(354), 1,
      anon_sym_RPAREN,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
  [2132] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(356), 1,
      aux_sym_relation_token1,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
  [2143] = 1,
    ACTIONS(358), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2150] = 1,
    ACTIONS(360), 4,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_else,
      sym_comment,
  [2157] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(362), 1,
      anon_sym_RPAREN,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
  [2168] = 2,
    ACTIONS(366), 1,
      anon_sym_else,
    ACTIONS(364), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
  [2177] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(368), 1,
      anon_sym_RPAREN,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
  [2188] = 2,
    ACTIONS(372), 1,
      anon_sym_else,
    ACTIONS(370), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
  [2197] = 3,
    ACTIONS(149), 1,
      aux_sym_product_token1,
    ACTIONS(374), 1,
      anon_sym_to,
    ACTIONS(157), 2,
      anon_sym_DASH,
      aux_sym_sum_token1,
  [2208] = 2,
    ACTIONS(378), 1,
      sym_comment,
    ACTIONS(376), 2,
      ts_builtin_sym_end,
      sym__line_end,
  [2216] = 3,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    STATE(80), 1,
      sym__target,
    STATE(82), 1,
      sym_number,
  [2226] = 3,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    STATE(81), 1,
      sym__target,
    STATE(82), 1,
      sym_number,
  [2236] = 2,
    ACTIONS(382), 1,
      anon_sym_then,
    ACTIONS(380), 2,
      anon_sym_and,
      anon_sym_or,
  [2244] = 1,
    ACTIONS(384), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
  [2250] = 1,
    ACTIONS(386), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
  [2256] = 3,
    ACTIONS(131), 1,
      aux_sym_line_number_token1,
    STATE(82), 1,
      sym_number,
    STATE(88), 1,
      sym__target,
  [2266] = 1,
    ACTIONS(388), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
  [2272] = 1,
    ACTIONS(390), 2,
      ts_builtin_sym_end,
      sym__line_end,
  [2277] = 2,
    ACTIONS(392), 1,
      sym_system_variable,
    ACTIONS(394), 1,
      sym_variable,
  [2284] = 2,
    ACTIONS(314), 1,
      ts_builtin_sym_end,
    ACTIONS(396), 1,
      sym__line_end,
  [2291] = 2,
    ACTIONS(297), 1,
      ts_builtin_sym_end,
    ACTIONS(396), 1,
      sym__line_end,
  [2298] = 2,
    ACTIONS(396), 1,
      sym__line_end,
    ACTIONS(398), 1,
      ts_builtin_sym_end,
  [2305] = 1,
    ACTIONS(400), 1,
      sym_variable,
  [2309] = 1,
    ACTIONS(402), 1,
      sym_variable,
  [2313] = 1,
    ACTIONS(404), 1,
      anon_sym_then,
  [2317] = 1,
    ACTIONS(406), 1,
      ts_builtin_sym_end,
  [2321] = 1,
    ACTIONS(408), 1,
      anon_sym_EQ,
  [2325] = 1,
    ACTIONS(410), 1,
      anon_sym_EQ,
  [2329] = 1,
    ACTIONS(412), 1,
      anon_sym_EQ,
  [2333] = 1,
    ACTIONS(396), 1,
      sym__line_end,
};

static const uint32_t ts_small_parse_table_map[] = {
  [SMALL_STATE(2)] = 0,
  [SMALL_STATE(3)] = 51,
  [SMALL_STATE(4)] = 96,
  [SMALL_STATE(5)] = 141,
  [SMALL_STATE(6)] = 186,
  [SMALL_STATE(7)] = 230,
  [SMALL_STATE(8)] = 274,
  [SMALL_STATE(9)] = 318,
  [SMALL_STATE(10)] = 359,
  [SMALL_STATE(11)] = 400,
  [SMALL_STATE(12)] = 441,
  [SMALL_STATE(13)] = 482,
  [SMALL_STATE(14)] = 516,
  [SMALL_STATE(15)] = 536,
  [SMALL_STATE(16)] = 556,
  [SMALL_STATE(17)] = 578,
  [SMALL_STATE(18)] = 598,
  [SMALL_STATE(19)] = 618,
  [SMALL_STATE(20)] = 642,
  [SMALL_STATE(21)] = 675,
  [SMALL_STATE(22)] = 696,
  [SMALL_STATE(23)] = 721,
  [SMALL_STATE(24)] = 746,
  [SMALL_STATE(25)] = 771,
  [SMALL_STATE(26)] = 792,
  [SMALL_STATE(27)] = 813,
  [SMALL_STATE(28)] = 834,
  [SMALL_STATE(29)] = 857,
  [SMALL_STATE(30)] = 878,
  [SMALL_STATE(31)] = 902,
  [SMALL_STATE(32)] = 926,
  [SMALL_STATE(33)] = 946,
  [SMALL_STATE(34)] = 966,
  [SMALL_STATE(35)] = 988,
  [SMALL_STATE(36)] = 1012,
  [SMALL_STATE(37)] = 1032,
  [SMALL_STATE(38)] = 1052,
  [SMALL_STATE(39)] = 1083,
  [SMALL_STATE(40)] = 1114,
  [SMALL_STATE(41)] = 1142,
  [SMALL_STATE(42)] = 1170,
  [SMALL_STATE(43)] = 1198,
  [SMALL_STATE(44)] = 1226,
  [SMALL_STATE(45)] = 1254,
  [SMALL_STATE(46)] = 1282,
  [SMALL_STATE(47)] = 1310,
  [SMALL_STATE(48)] = 1338,
  [SMALL_STATE(49)] = 1366,
  [SMALL_STATE(50)] = 1394,
  [SMALL_STATE(51)] = 1422,
  [SMALL_STATE(52)] = 1450,
  [SMALL_STATE(53)] = 1478,
  [SMALL_STATE(54)] = 1506,
  [SMALL_STATE(55)] = 1534,
  [SMALL_STATE(56)] = 1562,
  [SMALL_STATE(57)] = 1590,
  [SMALL_STATE(58)] = 1618,
  [SMALL_STATE(59)] = 1646,
  [SMALL_STATE(60)] = 1674,
  [SMALL_STATE(61)] = 1702,
  [SMALL_STATE(62)] = 1730,
  [SMALL_STATE(63)] = 1758,
  [SMALL_STATE(64)] = 1786,
  [SMALL_STATE(65)] = 1814,
  [SMALL_STATE(66)] = 1834,
  [SMALL_STATE(67)] = 1859,
  [SMALL_STATE(68)] = 1884,
  [SMALL_STATE(69)] = 1909,
  [SMALL_STATE(70)] = 1926,
  [SMALL_STATE(71)] = 1951,
  [SMALL_STATE(72)] = 1966,
  [SMALL_STATE(73)] = 1980,
  [SMALL_STATE(74)] = 1994,
  [SMALL_STATE(75)] = 2008,
  [SMALL_STATE(76)] = 2021,
  [SMALL_STATE(77)] = 2034,
  [SMALL_STATE(78)] = 2047,
  [SMALL_STATE(79)] = 2060,
  [SMALL_STATE(80)] = 2073,
  [SMALL_STATE(81)] = 2086,
  [SMALL_STATE(82)] = 2094,
  [SMALL_STATE(83)] = 2102,
  [SMALL_STATE(84)] = 2114,
  [SMALL_STATE(85)] = 2121,
  [SMALL_STATE(86)] = 2132,
  [SMALL_STATE(87)] = 2143,
  [SMALL_STATE(88)] = 2150,
  [SMALL_STATE(89)] = 2157,
  [SMALL_STATE(90)] = 2168,
  [SMALL_STATE(91)] = 2177,
  [SMALL_STATE(92)] = 2188,
  [SMALL_STATE(93)] = 2197,
  [SMALL_STATE(94)] = 2208,
  [SMALL_STATE(95)] = 2216,
  [SMALL_STATE(96)] = 2226,
  [SMALL_STATE(97)] = 2236,
  [SMALL_STATE(98)] = 2244,
  [SMALL_STATE(99)] = 2250,
  [SMALL_STATE(100)] = 2256,
  [SMALL_STATE(101)] = 2266,
  [SMALL_STATE(102)] = 2272,
  [SMALL_STATE(103)] = 2277,
  [SMALL_STATE(104)] = 2284,
  [SMALL_STATE(105)] = 2291,
  [SMALL_STATE(106)] = 2298,
  [SMALL_STATE(107)] = 2305,
  [SMALL_STATE(108)] = 2309,
  [SMALL_STATE(109)] = 2313,
  [SMALL_STATE(110)] = 2317,
  [SMALL_STATE(111)] = 2321,
  [SMALL_STATE(112)] = 2325,
  [SMALL_STATE(113)] = 2329,
  [SMALL_STATE(114)] = 2333,
};

static const TSParseActionEntry ts_parse_actions[] = {
  [0] = {.entry = {.count = 0, .reusable = false}},
  [1] = {.entry = {.count = 1, .reusable = false}}, RECOVER(),
  [3] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 0, 0, 0),
  [5] = {.entry = {.count = 1, .reusable = true}}, SHIFT(68),
  [7] = {.entry = {.count = 1, .reusable = true}}, SHIFT(21),
  [9] = {.entry = {.count = 1, .reusable = true}}, SHIFT(70),
  [11] = {.entry = {.count = 1, .reusable = true}}, SHIFT(104),
  [13] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_line, 1, 0, 1),
  [15] = {.entry = {.count = 1, .reusable = true}}, SHIFT(103),
  [17] = {.entry = {.count = 1, .reusable = true}}, SHIFT(39),
  [19] = {.entry = {.count = 1, .reusable = true}}, SHIFT(107),
  [21] = {.entry = {.count = 1, .reusable = true}}, SHIFT(108),
  [23] = {.entry = {.count = 1, .reusable = true}}, SHIFT(100),
  [25] = {.entry = {.count = 1, .reusable = true}}, SHIFT(49),
  [27] = {.entry = {.count = 1, .reusable = true}}, SHIFT(7),
  [29] = {.entry = {.count = 1, .reusable = true}}, SHIFT(20),
  [31] = {.entry = {.count = 1, .reusable = true}}, SHIFT(113),
  [33] = {.entry = {.count = 1, .reusable = false}}, SHIFT(113),
  [35] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_output, 1, 0, 0),
  [37] = {.entry = {.count = 1, .reusable = true}}, SHIFT(27),
  [39] = {.entry = {.count = 1, .reusable = true}}, SHIFT(5),
  [41] = {.entry = {.count = 1, .reusable = true}}, SHIFT(64),
  [43] = {.entry = {.count = 1, .reusable = true}}, SHIFT(41),
  [45] = {.entry = {.count = 1, .reusable = true}}, SHIFT(59),
  [47] = {.entry = {.count = 1, .reusable = true}}, SHIFT(60),
  [49] = {.entry = {.count = 1, .reusable = true}}, SHIFT(22),
  [51] = {.entry = {.count = 1, .reusable = false}}, SHIFT(22),
  [53] = {.entry = {.count = 1, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0),
  [55] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(27),
  [58] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(4),
  [61] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(64),
  [64] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(41),
  [67] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(59),
  [70] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(60),
  [73] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(22),
  [76] = {.entry = {.count = 2, .reusable = false}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(22),
  [79] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_output, 2, 0, 0),
  [81] = {.entry = {.count = 1, .reusable = true}}, SHIFT(4),
  [83] = {.entry = {.count = 1, .reusable = true}}, SHIFT(32),
  [85] = {.entry = {.count = 1, .reusable = true}}, SHIFT(8),
  [87] = {.entry = {.count = 1, .reusable = true}}, SHIFT(61),
  [89] = {.entry = {.count = 1, .reusable = true}}, SHIFT(63),
  [91] = {.entry = {.count = 1, .reusable = true}}, SHIFT(52),
  [93] = {.entry = {.count = 1, .reusable = true}}, SHIFT(53),
  [95] = {.entry = {.count = 1, .reusable = true}}, SHIFT(31),
  [97] = {.entry = {.count = 1, .reusable = false}}, SHIFT(31),
  [99] = {.entry = {.count = 1, .reusable = true}}, SHIFT(6),
  [101] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(32),
  [104] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(8),
  [107] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(61),
  [110] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(63),
  [113] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(52),
  [116] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(53),
  [119] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(31),
  [122] = {.entry = {.count = 2, .reusable = false}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0), SHIFT_REPEAT(31),
  [125] = {.entry = {.count = 1, .reusable = true}}, SHIFT(3),
  [127] = {.entry = {.count = 1, .reusable = true}}, SHIFT(13),
  [129] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_action, 1, 0, 2),
  [131] = {.entry = {.count = 1, .reusable = true}}, SHIFT(17),
  [133] = {.entry = {.count = 1, .reusable = true}}, SHIFT(54),
  [135] = {.entry = {.count = 1, .reusable = true}}, SHIFT(55),
  [137] = {.entry = {.count = 1, .reusable = true}}, SHIFT(58),
  [139] = {.entry = {.count = 1, .reusable = true}}, SHIFT(65),
  [141] = {.entry = {.count = 1, .reusable = false}}, SHIFT(65),
  [143] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_product, 3, 0, 0),
  [145] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_group, 3, 0, 0),
  [147] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_sum, 3, 0, 9),
  [149] = {.entry = {.count = 1, .reusable = true}}, SHIFT(46),
  [151] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_number, 1, 0, 0),
  [153] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_negation, 2, 0, 0),
  [155] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_call, 2, 0, 5),
  [157] = {.entry = {.count = 1, .reusable = true}}, SHIFT(45),
  [159] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_line_number, 1, 0, 0),
  [161] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_line_number, 1, 0, 0),
  [163] = {.entry = {.count = 1, .reusable = true}}, REDUCE(aux_sym_output_repeat1, 1, 0, 0),
  [165] = {.entry = {.count = 1, .reusable = true}}, SHIFT(40),
  [167] = {.entry = {.count = 1, .reusable = true}}, SHIFT(62),
  [169] = {.entry = {.count = 1, .reusable = false}}, REDUCE(aux_sym_output_repeat1, 1, 0, 0),
  [171] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_call, 2, 0, 5),
  [173] = {.entry = {.count = 1, .reusable = false}}, REDUCE(aux_sym_output_repeat1, 2, 0, 0),
  [175] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_group, 3, 0, 0),
  [177] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_negation, 2, 0, 0),
  [179] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_number, 1, 0, 0),
  [181] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_sum, 3, 0, 9),
  [183] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_product, 3, 0, 0),
  [185] = {.entry = {.count = 1, .reusable = true}}, SHIFT(56),
  [187] = {.entry = {.count = 1, .reusable = true}}, SHIFT(57),
  [189] = {.entry = {.count = 1, .reusable = true}}, SHIFT(86),
  [191] = {.entry = {.count = 1, .reusable = false}}, SHIFT(86),
  [193] = {.entry = {.count = 1, .reusable = true}}, SHIFT(28),
  [195] = {.entry = {.count = 1, .reusable = false}}, SHIFT(28),
  [197] = {.entry = {.count = 1, .reusable = true}}, SHIFT(91),
  [199] = {.entry = {.count = 1, .reusable = false}}, SHIFT(91),
  [201] = {.entry = {.count = 1, .reusable = true}}, SHIFT(73),
  [203] = {.entry = {.count = 1, .reusable = false}}, SHIFT(73),
  [205] = {.entry = {.count = 1, .reusable = true}}, SHIFT(74),
  [207] = {.entry = {.count = 1, .reusable = false}}, SHIFT(74),
  [209] = {.entry = {.count = 1, .reusable = true}}, SHIFT(79),
  [211] = {.entry = {.count = 1, .reusable = false}}, SHIFT(79),
  [213] = {.entry = {.count = 1, .reusable = true}}, SHIFT(16),
  [215] = {.entry = {.count = 1, .reusable = false}}, SHIFT(16),
  [217] = {.entry = {.count = 1, .reusable = true}}, SHIFT(14),
  [219] = {.entry = {.count = 1, .reusable = false}}, SHIFT(14),
  [221] = {.entry = {.count = 1, .reusable = true}}, SHIFT(93),
  [223] = {.entry = {.count = 1, .reusable = false}}, SHIFT(93),
  [225] = {.entry = {.count = 1, .reusable = true}}, SHIFT(71),
  [227] = {.entry = {.count = 1, .reusable = false}}, SHIFT(71),
  [229] = {.entry = {.count = 1, .reusable = true}}, SHIFT(83),
  [231] = {.entry = {.count = 1, .reusable = false}}, SHIFT(83),
  [233] = {.entry = {.count = 1, .reusable = true}}, SHIFT(69),
  [235] = {.entry = {.count = 1, .reusable = false}}, SHIFT(69),
  [237] = {.entry = {.count = 1, .reusable = true}}, SHIFT(72),
  [239] = {.entry = {.count = 1, .reusable = false}}, SHIFT(72),
  [241] = {.entry = {.count = 1, .reusable = true}}, SHIFT(36),
  [243] = {.entry = {.count = 1, .reusable = false}}, SHIFT(36),
  [245] = {.entry = {.count = 1, .reusable = true}}, SHIFT(35),
  [247] = {.entry = {.count = 1, .reusable = false}}, SHIFT(35),
  [249] = {.entry = {.count = 1, .reusable = true}}, SHIFT(85),
  [251] = {.entry = {.count = 1, .reusable = false}}, SHIFT(85),
  [253] = {.entry = {.count = 1, .reusable = true}}, SHIFT(18),
  [255] = {.entry = {.count = 1, .reusable = false}}, SHIFT(18),
  [257] = {.entry = {.count = 1, .reusable = true}}, SHIFT(34),
  [259] = {.entry = {.count = 1, .reusable = false}}, SHIFT(34),
  [261] = {.entry = {.count = 1, .reusable = true}}, SHIFT(33),
  [263] = {.entry = {.count = 1, .reusable = false}}, SHIFT(33),
  [265] = {.entry = {.count = 1, .reusable = true}}, SHIFT(19),
  [267] = {.entry = {.count = 1, .reusable = false}}, SHIFT(19),
  [269] = {.entry = {.count = 1, .reusable = true}}, SHIFT(26),
  [271] = {.entry = {.count = 1, .reusable = false}}, SHIFT(26),
  [273] = {.entry = {.count = 1, .reusable = true}}, SHIFT(23),
  [275] = {.entry = {.count = 1, .reusable = false}}, SHIFT(23),
  [277] = {.entry = {.count = 1, .reusable = true}}, SHIFT(30),
  [279] = {.entry = {.count = 1, .reusable = false}}, SHIFT(30),
  [281] = {.entry = {.count = 1, .reusable = true}}, SHIFT(29),
  [283] = {.entry = {.count = 1, .reusable = false}}, SHIFT(29),
  [285] = {.entry = {.count = 1, .reusable = true}}, SHIFT(89),
  [287] = {.entry = {.count = 1, .reusable = false}}, SHIFT(89),
  [289] = {.entry = {.count = 1, .reusable = true}}, SHIFT(24),
  [291] = {.entry = {.count = 1, .reusable = false}}, SHIFT(24),
  [293] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_action, 2, 0, 2),
  [295] = {.entry = {.count = 1, .reusable = true}}, SHIFT(48),
  [297] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 2, 0, 0),
  [299] = {.entry = {.count = 1, .reusable = true}}, SHIFT(67),
  [301] = {.entry = {.count = 1, .reusable = true}}, SHIFT(106),
  [303] = {.entry = {.count = 1, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0),
  [305] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0), SHIFT_REPEAT(21),
  [308] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0), SHIFT_REPEAT(67),
  [311] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0), SHIFT_REPEAT(114),
  [314] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 1, 0, 0),
  [316] = {.entry = {.count = 1, .reusable = true}}, SHIFT(66),
  [318] = {.entry = {.count = 1, .reusable = true}}, SHIFT(105),
  [320] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_loop, 6, 0, 3),
  [322] = {.entry = {.count = 1, .reusable = true}}, SHIFT(51),
  [324] = {.entry = {.count = 1, .reusable = true}}, REDUCE(aux_sym_action_repeat1, 2, 0, 0),
  [326] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_loop, 8, 0, 3),
  [328] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_assignment, 4, 0, 7),
  [330] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_assignment, 3, 0, 6),
  [332] = {.entry = {.count = 1, .reusable = true}}, REDUCE(aux_sym_indexed_jump_repeat1, 2, 0, 0),
  [334] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_indexed_jump_repeat1, 2, 0, 0), SHIFT_REPEAT(96),
  [337] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_action_repeat1, 2, 0, 0), SHIFT_REPEAT(48),
  [340] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_action, 3, 0, 2),
  [342] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_indexed_jump, 5, 0, 0),
  [344] = {.entry = {.count = 1, .reusable = true}}, SHIFT(96),
  [346] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_relation, 3, 0, 0),
  [348] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_indexed_jump, 4, 0, 0),
  [350] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__target, 1, 0, 4),
  [352] = {.entry = {.count = 1, .reusable = true}}, SHIFT(95),
  [354] = {.entry = {.count = 1, .reusable = true}}, SHIFT(15),
  [356] = {.entry = {.count = 1, .reusable = true}}, SHIFT(44),
  [358] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_loop_end, 2, 0, 3),
  [360] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_jump, 2, 0, 0),
  [362] = {.entry = {.count = 1, .reusable = true}}, SHIFT(37),
  [364] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_conditional, 4, 0, 8),
  [366] = {.entry = {.count = 1, .reusable = true}}, SHIFT(12),
  [368] = {.entry = {.count = 1, .reusable = true}}, SHIFT(25),
  [370] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_conditional, 6, 0, 10),
  [372] = {.entry = {.count = 1, .reusable = true}}, SHIFT(9),
  [374] = {.entry = {.count = 1, .reusable = true}}, SHIFT(50),
  [376] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__content, 1, 0, 0),
  [378] = {.entry = {.count = 1, .reusable = true}}, SHIFT(102),
  [380] = {.entry = {.count = 1, .reusable = true}}, SHIFT(38),
  [382] = {.entry = {.count = 1, .reusable = true}}, SHIFT(11),
  [384] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_conditional, 6, 0, 11),
  [386] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_line, 2, 0, 1),
  [388] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_conditional, 8, 0, 12),
  [390] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__content, 2, 0, 0),
  [392] = {.entry = {.count = 1, .reusable = true}}, SHIFT(111),
  [394] = {.entry = {.count = 1, .reusable = false}}, SHIFT(111),
  [396] = {.entry = {.count = 1, .reusable = true}}, SHIFT(84),
  [398] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 3, 0, 0),
  [400] = {.entry = {.count = 1, .reusable = true}}, SHIFT(112),
  [402] = {.entry = {.count = 1, .reusable = true}}, SHIFT(87),
  [404] = {.entry = {.count = 1, .reusable = true}}, SHIFT(10),
  [406] = {.entry = {.count = 1, .reusable = true}},  ACCEPT_INPUT(),
  [408] = {.entry = {.count = 1, .reusable = true}}, SHIFT(42),
  [410] = {.entry = {.count = 1, .reusable = true}}, SHIFT(47),
  [412] = {.entry = {.count = 1, .reusable = true}}, SHIFT(43),
};

#ifdef __cplusplus
extern "C" {
#endif
#ifdef TREE_SITTER_HIDE_SYMBOLS
#define TS_PUBLIC
#elif defined(_WIN32)
#define TS_PUBLIC __declspec(dllexport)
#else
#define TS_PUBLIC __attribute__((visibility("default")))
#endif

TS_PUBLIC const TSLanguage *tree_sitter_orbbasic(void) {
  static const TSLanguage language = {
    .version = LANGUAGE_VERSION,
    .symbol_count = SYMBOL_COUNT,
    .alias_count = ALIAS_COUNT,
    .token_count = TOKEN_COUNT,
    .external_token_count = EXTERNAL_TOKEN_COUNT,
    .state_count = STATE_COUNT,
    .large_state_count = LARGE_STATE_COUNT,
    .production_id_count = PRODUCTION_ID_COUNT,
    .field_count = FIELD_COUNT,
    .max_alias_sequence_length = MAX_ALIAS_SEQUENCE_LENGTH,
    .parse_table = &ts_parse_table[0][0],
    .small_parse_table = ts_small_parse_table,
    .small_parse_table_map = ts_small_parse_table_map,
    .parse_actions = ts_parse_actions,
    .symbol_names = ts_symbol_names,
    .field_names = ts_field_names,
    .field_map_slices = ts_field_map_slices,
    .field_map_entries = ts_field_map_entries,
    .symbol_metadata = ts_symbol_metadata,
    .public_symbol_map = ts_symbol_map,
    .alias_map = ts_non_terminal_alias_map,
    .alias_sequences = &ts_alias_sequences[0][0],
    .lex_modes = ts_lex_modes,
    .lex_fn = ts_lex,
    .keyword_lex_fn = ts_lex_keywords,
    .keyword_capture_token = sym__word,
    .primary_state_ids = ts_primary_state_ids,
  };
  return &language;
}
#ifdef __cplusplus
}
#endif
