// Made from grammar.js (cffbecc064d1a9a01ea696ed487d99346e5f588bf684514bde60475279d2cc30) by `./dev grammars`.
#include "tree_sitter/parser.h"

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif

#define LANGUAGE_VERSION 14
#define STATE_COUNT 31
#define LARGE_STATE_COUNT 7
#define SYMBOL_COUNT 22
#define ALIAS_COUNT 0
#define TOKEN_COUNT 12
#define EXTERNAL_TOKEN_COUNT 0
#define FIELD_COUNT 2
#define MAX_ALIAS_SEQUENCE_LENGTH 3
#define PRODUCTION_ID_COUNT 5

enum ts_symbol_identifiers {
  sym_word = 1,
  aux_sym_program_token1 = 2,
  sym__line_end = 3,
  anon_sym_COMMA = 4,
  anon_sym_EQ = 5,
  sym_directive_word = 6,
  sym_command_word = 7,
  sym_value_word = 8,
  sym_number = 9,
  sym_string = 10,
  sym_comment = 11,
  sym_program = 12,
  sym__line = 13,
  sym_directive = 14,
  sym_command = 15,
  sym__operands = 16,
  sym__operand = 17,
  sym_operand = 18,
  sym__value = 19,
  aux_sym_program_repeat1 = 20,
  aux_sym__operands_repeat1 = 21,
};

static const char * const ts_symbol_names[] = {
  [ts_builtin_sym_end] = "end",
  [sym_word] = "word",
  [aux_sym_program_token1] = "program_token1",
  [sym__line_end] = "_line_end",
  [anon_sym_COMMA] = ",",
  [anon_sym_EQ] = "=",
  [sym_directive_word] = "directive_word",
  [sym_command_word] = "command_word",
  [sym_value_word] = "value_word",
  [sym_number] = "number",
  [sym_string] = "string",
  [sym_comment] = "comment",
  [sym_program] = "program",
  [sym__line] = "_line",
  [sym_directive] = "directive",
  [sym_command] = "command",
  [sym__operands] = "_operands",
  [sym__operand] = "_operand",
  [sym_operand] = "operand",
  [sym__value] = "_value",
  [aux_sym_program_repeat1] = "program_repeat1",
  [aux_sym__operands_repeat1] = "_operands_repeat1",
};

static const TSSymbol ts_symbol_map[] = {
  [ts_builtin_sym_end] = ts_builtin_sym_end,
  [sym_word] = sym_word,
  [aux_sym_program_token1] = aux_sym_program_token1,
  [sym__line_end] = sym__line_end,
  [anon_sym_COMMA] = anon_sym_COMMA,
  [anon_sym_EQ] = anon_sym_EQ,
  [sym_directive_word] = sym_directive_word,
  [sym_command_word] = sym_command_word,
  [sym_value_word] = sym_value_word,
  [sym_number] = sym_number,
  [sym_string] = sym_string,
  [sym_comment] = sym_comment,
  [sym_program] = sym_program,
  [sym__line] = sym__line,
  [sym_directive] = sym_directive,
  [sym_command] = sym_command,
  [sym__operands] = sym__operands,
  [sym__operand] = sym__operand,
  [sym_operand] = sym_operand,
  [sym__value] = sym__value,
  [aux_sym_program_repeat1] = aux_sym_program_repeat1,
  [aux_sym__operands_repeat1] = aux_sym__operands_repeat1,
};

static const TSSymbolMetadata ts_symbol_metadata[] = {
  [ts_builtin_sym_end] = {
    .visible = false,
    .named = true,
  },
  [sym_word] = {
    .visible = true,
    .named = true,
  },
  [aux_sym_program_token1] = {
    .visible = false,
    .named = false,
  },
  [sym__line_end] = {
    .visible = false,
    .named = true,
  },
  [anon_sym_COMMA] = {
    .visible = true,
    .named = false,
  },
  [anon_sym_EQ] = {
    .visible = true,
    .named = false,
  },
  [sym_directive_word] = {
    .visible = true,
    .named = true,
  },
  [sym_command_word] = {
    .visible = true,
    .named = true,
  },
  [sym_value_word] = {
    .visible = true,
    .named = true,
  },
  [sym_number] = {
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
  [sym__line] = {
    .visible = false,
    .named = true,
  },
  [sym_directive] = {
    .visible = true,
    .named = true,
  },
  [sym_command] = {
    .visible = true,
    .named = true,
  },
  [sym__operands] = {
    .visible = false,
    .named = true,
  },
  [sym__operand] = {
    .visible = false,
    .named = true,
  },
  [sym_operand] = {
    .visible = true,
    .named = true,
  },
  [sym__value] = {
    .visible = false,
    .named = true,
  },
  [aux_sym_program_repeat1] = {
    .visible = false,
    .named = false,
  },
  [aux_sym__operands_repeat1] = {
    .visible = false,
    .named = false,
  },
};

enum ts_field_identifiers {
  field_name = 1,
  field_value = 2,
};

static const char * const ts_field_names[] = {
  [0] = NULL,
  [field_name] = "name",
  [field_value] = "value",
};

static const TSFieldMapSlice ts_field_map_slices[PRODUCTION_ID_COUNT] = {
  [1] = {.index = 0, .length = 1},
  [3] = {.index = 1, .length = 2},
  [4] = {.index = 1, .length = 2},
};

static const TSFieldMapEntry ts_field_map_entries[] = {
  [0] =
    {field_name, 0},
  [1] =
    {field_name, 0},
    {field_value, 2},
};

static const TSSymbol ts_alias_sequences[PRODUCTION_ID_COUNT][MAX_ALIAS_SEQUENCE_LENGTH] = {
  [0] = {0},
  [2] = {
    [0] = sym_word,
  },
  [3] = {
    [0] = sym_word,
  },
};

static const uint16_t ts_non_terminal_alias_map[] = {
  0,
};

static const TSStateId ts_primary_state_ids[STATE_COUNT] = {
  [0] = 0,
  [1] = 1,
  [2] = 2,
  [3] = 3,
  [4] = 4,
  [5] = 5,
  [6] = 6,
  [7] = 7,
  [8] = 8,
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
  [20] = 20,
  [21] = 21,
  [22] = 22,
  [23] = 23,
  [24] = 24,
  [25] = 25,
  [26] = 26,
  [27] = 27,
  [28] = 28,
  [29] = 29,
  [30] = 30,
};

static bool ts_lex(TSLexer *lexer, TSStateId state) {
  START_LEXER();
  eof = lexer->eof(lexer);
  switch (state) {
    case 0:
      if (eof) ADVANCE(20);
      ADVANCE_MAP(
        '\n', 22,
        '\r', 23,
        '"', 1,
        ',', 24,
        '.', 5,
        '0', 27,
        '=', 25,
        0xfeff, 21,
      );
      if (lookahead == '\t' ||
          lookahead == ' ') SKIP(0);
      if (lookahead == '#' ||
          lookahead == ';') ADVANCE(33);
      if (('+' <= lookahead && lookahead <= '-')) ADVANCE(2);
      if (('1' <= lookahead && lookahead <= '9')) ADVANCE(28);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          lookahead == '_' ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(34);
      END_STATE();
    case 1:
      if (lookahead == '"') ADVANCE(32);
      if (lookahead == '\\') ADVANCE(19);
      if (lookahead != 0 &&
          lookahead != '\n' &&
          lookahead != '\r') ADVANCE(1);
      END_STATE();
    case 2:
      if (lookahead == '0') ADVANCE(27);
      if (('1' <= lookahead && lookahead <= '9')) ADVANCE(28);
      END_STATE();
    case 3:
      if (lookahead == 'a') ADVANCE(6);
      END_STATE();
    case 4:
      if (lookahead == 'a') ADVANCE(17);
      END_STATE();
    case 5:
      if (lookahead == 'c') ADVANCE(11);
      if (lookahead == 'm') ADVANCE(3);
      if (lookahead == 'n') ADVANCE(12);
      if (lookahead == 'r') ADVANCE(4);
      END_STATE();
    case 6:
      if (lookahead == 'c') ADVANCE(14);
      END_STATE();
    case 7:
      if (lookahead == 'd') ADVANCE(26);
      END_STATE();
    case 8:
      if (lookahead == 'e') ADVANCE(10);
      END_STATE();
    case 9:
      if (lookahead == 'n') ADVANCE(15);
      END_STATE();
    case 10:
      if (lookahead == 'n') ADVANCE(7);
      END_STATE();
    case 11:
      if (lookahead == 'o') ADVANCE(9);
      END_STATE();
    case 12:
      if (lookahead == 'o') ADVANCE(8);
      END_STATE();
    case 13:
      if (lookahead == 'o') ADVANCE(26);
      END_STATE();
    case 14:
      if (lookahead == 'r') ADVANCE(13);
      END_STATE();
    case 15:
      if (lookahead == 's') ADVANCE(16);
      END_STATE();
    case 16:
      if (lookahead == 't') ADVANCE(26);
      END_STATE();
    case 17:
      if (lookahead == 'w') ADVANCE(26);
      END_STATE();
    case 18:
      if (('0' <= lookahead && lookahead <= '9')) ADVANCE(29);
      END_STATE();
    case 19:
      if (lookahead != 0 &&
          lookahead != '\n' &&
          lookahead != '\r') ADVANCE(1);
      END_STATE();
    case 20:
      ACCEPT_TOKEN(ts_builtin_sym_end);
      END_STATE();
    case 21:
      ACCEPT_TOKEN(aux_sym_program_token1);
      END_STATE();
    case 22:
      ACCEPT_TOKEN(sym__line_end);
      END_STATE();
    case 23:
      ACCEPT_TOKEN(sym__line_end);
      if (lookahead == '\n') ADVANCE(22);
      END_STATE();
    case 24:
      ACCEPT_TOKEN(anon_sym_COMMA);
      END_STATE();
    case 25:
      ACCEPT_TOKEN(anon_sym_EQ);
      END_STATE();
    case 26:
      ACCEPT_TOKEN(sym_directive_word);
      END_STATE();
    case 27:
      ACCEPT_TOKEN(sym_number);
      if (lookahead == '.') ADVANCE(18);
      if (lookahead == 'X' ||
          lookahead == 'x') ADVANCE(30);
      if (('0' <= lookahead && lookahead <= '9')) ADVANCE(28);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          lookahead == '_' ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(31);
      END_STATE();
    case 28:
      ACCEPT_TOKEN(sym_number);
      if (lookahead == '.') ADVANCE(18);
      if (('0' <= lookahead && lookahead <= '9')) ADVANCE(28);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          lookahead == '_' ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(31);
      END_STATE();
    case 29:
      ACCEPT_TOKEN(sym_number);
      if (('0' <= lookahead && lookahead <= '9')) ADVANCE(29);
      if (('A' <= lookahead && lookahead <= 'Z') ||
          lookahead == '_' ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(31);
      END_STATE();
    case 30:
      ACCEPT_TOKEN(sym_number);
      if (('0' <= lookahead && lookahead <= '9') ||
          ('A' <= lookahead && lookahead <= 'F') ||
          ('a' <= lookahead && lookahead <= 'f')) ADVANCE(30);
      if (('G' <= lookahead && lookahead <= 'Z') ||
          lookahead == '_' ||
          ('g' <= lookahead && lookahead <= 'z')) ADVANCE(31);
      END_STATE();
    case 31:
      ACCEPT_TOKEN(sym_number);
      if (('0' <= lookahead && lookahead <= '9') ||
          ('A' <= lookahead && lookahead <= 'Z') ||
          lookahead == '_' ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(31);
      END_STATE();
    case 32:
      ACCEPT_TOKEN(sym_string);
      END_STATE();
    case 33:
      ACCEPT_TOKEN(sym_comment);
      if (lookahead != 0 &&
          lookahead != '\n' &&
          lookahead != '\r') ADVANCE(33);
      END_STATE();
    case 34:
      ACCEPT_TOKEN(sym_word);
      if (('0' <= lookahead && lookahead <= '9') ||
          ('A' <= lookahead && lookahead <= 'Z') ||
          lookahead == '_' ||
          ('a' <= lookahead && lookahead <= 'z')) ADVANCE(34);
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
        'a', 1,
        'b', 2,
        'c', 3,
        'd', 4,
        'e', 5,
        'f', 6,
        'g', 7,
        'i', 8,
        'l', 9,
        'm', 10,
        'o', 11,
        'r', 12,
        's', 13,
        'u', 14,
        'w', 15,
      );
      if (lookahead == '\t' ||
          lookahead == ' ') SKIP(0);
      END_STATE();
    case 1:
      if (lookahead == 'l') ADVANCE(16);
      END_STATE();
    case 2:
      if (lookahead == 'a') ADVANCE(17);
      if (lookahead == 'r') ADVANCE(18);
      END_STATE();
    case 3:
      if (lookahead == 'o') ADVANCE(19);
      END_STATE();
    case 4:
      if (lookahead == 'e') ADVANCE(20);
      END_STATE();
    case 5:
      if (lookahead == 'n') ADVANCE(21);
      if (lookahead == 'x') ADVANCE(22);
      END_STATE();
    case 6:
      if (lookahead == 'a') ADVANCE(23);
      if (lookahead == 'o') ADVANCE(24);
      END_STATE();
    case 7:
      if (lookahead == 'o') ADVANCE(25);
      END_STATE();
    case 8:
      if (lookahead == 'g') ADVANCE(26);
      if (lookahead == 'n') ADVANCE(27);
      END_STATE();
    case 9:
      if (lookahead == 'o') ADVANCE(28);
      END_STATE();
    case 10:
      if (lookahead == 'a') ADVANCE(29);
      if (lookahead == 'o') ADVANCE(30);
      END_STATE();
    case 11:
      if (lookahead == 'f') ADVANCE(31);
      if (lookahead == 'n') ADVANCE(32);
      END_STATE();
    case 12:
      if (lookahead == 'a') ADVANCE(33);
      if (lookahead == 'e') ADVANCE(34);
      if (lookahead == 'g') ADVANCE(35);
      if (lookahead == 'o') ADVANCE(36);
      END_STATE();
    case 13:
      if (lookahead == 'e') ADVANCE(37);
      if (lookahead == 'l') ADVANCE(38);
      if (lookahead == 't') ADVANCE(39);
      END_STATE();
    case 14:
      if (lookahead == 'n') ADVANCE(40);
      END_STATE();
    case 15:
      if (lookahead == 'a') ADVANCE(41);
      END_STATE();
    case 16:
      if (lookahead == 'l') ADVANCE(42);
      END_STATE();
    case 17:
      if (lookahead == 'c') ADVANCE(43);
      END_STATE();
    case 18:
      if (lookahead == 'a') ADVANCE(44);
      END_STATE();
    case 19:
      if (lookahead == 'm') ADVANCE(45);
      if (lookahead == 'n') ADVANCE(46);
      END_STATE();
    case 20:
      if (lookahead == 'l') ADVANCE(47);
      END_STATE();
    case 21:
      if (lookahead == 'd') ADVANCE(48);
      END_STATE();
    case 22:
      if (lookahead == 'c') ADVANCE(49);
      if (lookahead == 't') ADVANCE(50);
      END_STATE();
    case 23:
      if (lookahead == 'd') ADVANCE(51);
      END_STATE();
    case 24:
      if (lookahead == 'r') ADVANCE(52);
      END_STATE();
    case 25:
      if (lookahead == 's') ADVANCE(53);
      if (lookahead == 't') ADVANCE(54);
      END_STATE();
    case 26:
      if (lookahead == 'n') ADVANCE(55);
      END_STATE();
    case 27:
      if (lookahead == 'h') ADVANCE(56);
      END_STATE();
    case 28:
      if (lookahead == 'o') ADVANCE(57);
      END_STATE();
    case 29:
      if (lookahead == 'r') ADVANCE(58);
      END_STATE();
    case 30:
      if (lookahead == 't') ADVANCE(59);
      END_STATE();
    case 31:
      if (lookahead == 'f') ADVANCE(60);
      END_STATE();
    case 32:
      ACCEPT_TOKEN(sym_value_word);
      if (lookahead == '_') ADVANCE(61);
      END_STATE();
    case 33:
      if (lookahead == 'w') ADVANCE(62);
      END_STATE();
    case 34:
      if (lookahead == 'v') ADVANCE(63);
      END_STATE();
    case 35:
      if (lookahead == 'b') ADVANCE(64);
      END_STATE();
    case 36:
      if (lookahead == 'l') ADVANCE(65);
      if (lookahead == 't') ADVANCE(66);
      END_STATE();
    case 37:
      if (lookahead == 't') ADVANCE(67);
      END_STATE();
    case 38:
      if (lookahead == 'e') ADVANCE(68);
      END_STATE();
    case 39:
      if (lookahead == 'a') ADVANCE(69);
      if (lookahead == 'e') ADVANCE(70);
      if (lookahead == 'r') ADVANCE(71);
      END_STATE();
    case 40:
      if (lookahead == 'k') ADVANCE(72);
      END_STATE();
    case 41:
      if (lookahead == 'i') ADVANCE(73);
      END_STATE();
    case 42:
      if (lookahead == 'o') ADVANCE(74);
      END_STATE();
    case 43:
      if (lookahead == 'k') ADVANCE(75);
      END_STATE();
    case 44:
      if (lookahead == 'k') ADVANCE(76);
      END_STATE();
    case 45:
      if (lookahead == 'm') ADVANCE(77);
      END_STATE();
    case 46:
      if (lookahead == 'f') ADVANCE(78);
      END_STATE();
    case 47:
      if (lookahead == 'a') ADVANCE(79);
      END_STATE();
    case 48:
      ACCEPT_TOKEN(sym_command_word);
      if (lookahead == 's') ADVANCE(80);
      END_STATE();
    case 49:
      if (lookahead == 'l') ADVANCE(81);
      END_STATE();
    case 50:
      if (lookahead == '_') ADVANCE(82);
      END_STATE();
    case 51:
      if (lookahead == 'e') ADVANCE(83);
      END_STATE();
    case 52:
      if (lookahead == 'w') ADVANCE(84);
      END_STATE();
    case 53:
      if (lookahead == 'u') ADVANCE(85);
      END_STATE();
    case 54:
      if (lookahead == 'o') ADVANCE(83);
      END_STATE();
    case 55:
      if (lookahead == 'o') ADVANCE(86);
      END_STATE();
    case 56:
      if (lookahead == '_') ADVANCE(87);
      END_STATE();
    case 57:
      if (lookahead == 'p') ADVANCE(88);
      END_STATE();
    case 58:
      if (lookahead == 'k') ADVANCE(89);
      END_STATE();
    case 59:
      if (lookahead == 'o') ADVANCE(90);
      END_STATE();
    case 60:
      ACCEPT_TOKEN(sym_value_word);
      END_STATE();
    case 61:
      if (lookahead == 'c') ADVANCE(91);
      if (lookahead == 'w') ADVANCE(92);
      END_STATE();
    case 62:
      if (lookahead == '_') ADVANCE(93);
      END_STATE();
    case 63:
      if (lookahead == 'e') ADVANCE(94);
      END_STATE();
    case 64:
      ACCEPT_TOKEN(sym_command_word);
      if (lookahead == '_') ADVANCE(95);
      END_STATE();
    case 65:
      if (lookahead == 'l') ADVANCE(96);
      END_STATE();
    case 66:
      if (lookahead == 'a') ADVANCE(97);
      END_STATE();
    case 67:
      if (lookahead == '_') ADVANCE(98);
      END_STATE();
    case 68:
      if (lookahead == 'e') ADVANCE(99);
      END_STATE();
    case 69:
      if (lookahead == 'b') ADVANCE(100);
      END_STATE();
    case 70:
      if (lookahead == 'a') ADVANCE(101);
      END_STATE();
    case 71:
      if (lookahead == 'e') ADVANCE(102);
      END_STATE();
    case 72:
      if (lookahead == 'i') ADVANCE(103);
      END_STATE();
    case 73:
      if (lookahead == 't') ADVANCE(104);
      END_STATE();
    case 74:
      if (lookahead == 'w') ADVANCE(105);
      END_STATE();
    case 75:
      if (lookahead == '_') ADVANCE(106);
      END_STATE();
    case 76:
      if (lookahead == 'e') ADVANCE(60);
      END_STATE();
    case 77:
      if (lookahead == 'e') ADVANCE(107);
      END_STATE();
    case 78:
      if (lookahead == 'i') ADVANCE(108);
      END_STATE();
    case 79:
      if (lookahead == 'y') ADVANCE(83);
      END_STATE();
    case 80:
      if (lookahead == 'i') ADVANCE(109);
      END_STATE();
    case 81:
      if (lookahead == 'u') ADVANCE(110);
      END_STATE();
    case 82:
      if (lookahead == 'f') ADVANCE(111);
      END_STATE();
    case 83:
      ACCEPT_TOKEN(sym_command_word);
      END_STATE();
    case 84:
      if (lookahead == 'a') ADVANCE(112);
      END_STATE();
    case 85:
      if (lookahead == 'b') ADVANCE(83);
      END_STATE();
    case 86:
      if (lookahead == 'r') ADVANCE(113);
      END_STATE();
    case 87:
      if (lookahead == 'i') ADVANCE(114);
      END_STATE();
    case 88:
      if (lookahead == '_') ADVANCE(115);
      END_STATE();
    case 89:
      if (lookahead == 'e') ADVANCE(116);
      END_STATE();
    case 90:
      if (lookahead == 'r') ADVANCE(117);
      END_STATE();
    case 91:
      if (lookahead == 'o') ADVANCE(118);
      END_STATE();
    case 92:
      if (lookahead == 'i') ADVANCE(119);
      END_STATE();
    case 93:
      if (lookahead == 'm') ADVANCE(120);
      END_STATE();
    case 94:
      if (lookahead == 'r') ADVANCE(121);
      END_STATE();
    case 95:
      if (lookahead == 's') ADVANCE(122);
      END_STATE();
    case 96:
      ACCEPT_TOKEN(sym_command_word);
      if (lookahead == '2') ADVANCE(83);
      if (lookahead == '_') ADVANCE(123);
      END_STATE();
    case 97:
      if (lookahead == 't') ADVANCE(124);
      END_STATE();
    case 98:
      if (lookahead == 'h') ADVANCE(125);
      if (lookahead == 's') ADVANCE(126);
      END_STATE();
    case 99:
      if (lookahead == 'p') ADVANCE(83);
      END_STATE();
    case 100:
      if (lookahead == 'i') ADVANCE(127);
      END_STATE();
    case 101:
      if (lookahead == 'l') ADVANCE(128);
      END_STATE();
    case 102:
      if (lookahead == 'a') ADVANCE(129);
      END_STATE();
    case 103:
      if (lookahead == 'l') ADVANCE(130);
      END_STATE();
    case 104:
      if (lookahead == '_') ADVANCE(131);
      END_STATE();
    case 105:
      if (lookahead == '_') ADVANCE(132);
      END_STATE();
    case 106:
      if (lookahead == 'l') ADVANCE(133);
      END_STATE();
    case 107:
      if (lookahead == 'n') ADVANCE(134);
      END_STATE();
    case 108:
      if (lookahead == 'g') ADVANCE(135);
      END_STATE();
    case 109:
      if (lookahead == 'g') ADVANCE(60);
      END_STATE();
    case 110:
      if (lookahead == 's') ADVANCE(136);
      END_STATE();
    case 111:
      if (lookahead == 'l') ADVANCE(137);
      END_STATE();
    case 112:
      if (lookahead == 'r') ADVANCE(138);
      END_STATE();
    case 113:
      if (lookahead == 'e') ADVANCE(60);
      END_STATE();
    case 114:
      if (lookahead == 'f') ADVANCE(139);
      END_STATE();
    case 115:
      if (lookahead == 'e') ADVANCE(140);
      if (lookahead == 's') ADVANCE(141);
      END_STATE();
    case 116:
      if (lookahead == 'r') ADVANCE(83);
      END_STATE();
    case 117:
      if (lookahead == '_') ADVANCE(142);
      END_STATE();
    case 118:
      if (lookahead == 'l') ADVANCE(143);
      END_STATE();
    case 119:
      if (lookahead == 't') ADVANCE(144);
      END_STATE();
    case 120:
      if (lookahead == 'o') ADVANCE(145);
      END_STATE();
    case 121:
      if (lookahead == 's') ADVANCE(146);
      END_STATE();
    case 122:
      if (lookahead == 'd') ADVANCE(147);
      END_STATE();
    case 123:
      if (lookahead == 's') ADVANCE(148);
      END_STATE();
    case 124:
      if (lookahead == 'e') ADVANCE(149);
      if (lookahead == 'i') ADVANCE(150);
      END_STATE();
    case 125:
      if (lookahead == 'e') ADVANCE(151);
      END_STATE();
    case 126:
      if (lookahead == 'd') ADVANCE(152);
      if (lookahead == 'p') ADVANCE(153);
      END_STATE();
    case 127:
      if (lookahead == 'l') ADVANCE(154);
      END_STATE();
    case 128:
      if (lookahead == 't') ADVANCE(155);
      END_STATE();
    case 129:
      if (lookahead == 'm') ADVANCE(156);
      END_STATE();
    case 130:
      if (lookahead == 'l') ADVANCE(157);
      END_STATE();
    case 131:
      if (lookahead == 'u') ADVANCE(158);
      END_STATE();
    case 132:
      if (lookahead == 's') ADVANCE(159);
      END_STATE();
    case 133:
      if (lookahead == 'e') ADVANCE(160);
      END_STATE();
    case 134:
      if (lookahead == 't') ADVANCE(83);
      END_STATE();
    case 135:
      if (lookahead == 'u') ADVANCE(161);
      END_STATE();
    case 136:
      if (lookahead == 'i') ADVANCE(162);
      END_STATE();
    case 137:
      if (lookahead == 'a') ADVANCE(163);
      END_STATE();
    case 138:
      if (lookahead == 'd') ADVANCE(60);
      END_STATE();
    case 139:
      if (lookahead == '_') ADVANCE(164);
      END_STATE();
    case 140:
      if (lookahead == 'n') ADVANCE(165);
      END_STATE();
    case 141:
      if (lookahead == 't') ADVANCE(166);
      END_STATE();
    case 142:
      if (lookahead == 'c') ADVANCE(167);
      END_STATE();
    case 143:
      if (lookahead == 'l') ADVANCE(168);
      END_STATE();
    case 144:
      if (lookahead == 'h') ADVANCE(169);
      END_STATE();
    case 145:
      if (lookahead == 't') ADVANCE(170);
      END_STATE();
    case 146:
      if (lookahead == 'e') ADVANCE(60);
      END_STATE();
    case 147:
      if (lookahead == '2') ADVANCE(83);
      END_STATE();
    case 148:
      if (lookahead == 'd') ADVANCE(171);
      if (lookahead == 'p') ADVANCE(172);
      END_STATE();
    case 149:
      ACCEPT_TOKEN(sym_command_word);
      if (lookahead == '_') ADVANCE(173);
      END_STATE();
    case 150:
      if (lookahead == 'o') ADVANCE(174);
      END_STATE();
    case 151:
      if (lookahead == 'a') ADVANCE(175);
      END_STATE();
    case 152:
      if (lookahead == '1' ||
          lookahead == '2') ADVANCE(83);
      END_STATE();
    case 153:
      if (lookahead == 'd') ADVANCE(176);
      if (lookahead == 'e') ADVANCE(177);
      END_STATE();
    case 154:
      if (lookahead == 'i') ADVANCE(178);
      END_STATE();
    case 155:
      if (lookahead == 'h') ADVANCE(60);
      END_STATE();
    case 156:
      if (lookahead == '_') ADVANCE(179);
      END_STATE();
    case 157:
      if (lookahead == 'a') ADVANCE(180);
      END_STATE();
    case 158:
      if (lookahead == 'n') ADVANCE(181);
      END_STATE();
    case 159:
      if (lookahead == 'o') ADVANCE(182);
      END_STATE();
    case 160:
      if (lookahead == 'd') ADVANCE(83);
      END_STATE();
    case 161:
      if (lookahead == 'r') ADVANCE(183);
      END_STATE();
    case 162:
      if (lookahead == 'v') ADVANCE(184);
      END_STATE();
    case 163:
      if (lookahead == 'g') ADVANCE(185);
      END_STATE();
    case 164:
      if (lookahead == 'c') ADVANCE(186);
      END_STATE();
    case 165:
      if (lookahead == 'd') ADVANCE(83);
      END_STATE();
    case 166:
      if (lookahead == 'a') ADVANCE(187);
      END_STATE();
    case 167:
      if (lookahead == 'o') ADVANCE(188);
      END_STATE();
    case 168:
      if (lookahead == 'i') ADVANCE(189);
      END_STATE();
    case 169:
      if (lookahead == 'o') ADVANCE(190);
      END_STATE();
    case 170:
      if (lookahead == 'o') ADVANCE(191);
      END_STATE();
    case 171:
      if (lookahead == '1') ADVANCE(83);
      END_STATE();
    case 172:
      if (lookahead == 'd') ADVANCE(192);
      END_STATE();
    case 173:
      if (lookahead == 's') ADVANCE(193);
      END_STATE();
    case 174:
      if (lookahead == 'n') ADVANCE(194);
      END_STATE();
    case 175:
      if (lookahead == 'd') ADVANCE(195);
      END_STATE();
    case 176:
      if (lookahead == '1' ||
          lookahead == '2') ADVANCE(83);
      END_STATE();
    case 177:
      if (lookahead == 'e') ADVANCE(196);
      END_STATE();
    case 178:
      if (lookahead == 'z') ADVANCE(197);
      END_STATE();
    case 179:
      if (lookahead == 'e') ADVANCE(198);
      END_STATE();
    case 180:
      if (lookahead == 'b') ADVANCE(199);
      END_STATE();
    case 181:
      if (lookahead == 't') ADVANCE(200);
      END_STATE();
    case 182:
      if (lookahead == 'd') ADVANCE(60);
      END_STATE();
    case 183:
      if (lookahead == 'e') ADVANCE(201);
      END_STATE();
    case 184:
      if (lookahead == 'e') ADVANCE(202);
      END_STATE();
    case 185:
      if (lookahead == 's') ADVANCE(60);
      END_STATE();
    case 186:
      if (lookahead == 'o') ADVANCE(203);
      END_STATE();
    case 187:
      if (lookahead == 'r') ADVANCE(204);
      END_STATE();
    case 188:
      if (lookahead == 'n') ADVANCE(205);
      END_STATE();
    case 189:
      if (lookahead == 's') ADVANCE(206);
      END_STATE();
    case 190:
      if (lookahead == 'u') ADVANCE(207);
      END_STATE();
    case 191:
      if (lookahead == 'r') ADVANCE(208);
      END_STATE();
    case 192:
      if (lookahead == '1') ADVANCE(209);
      if (lookahead == '2') ADVANCE(210);
      END_STATE();
    case 193:
      if (lookahead == 'd') ADVANCE(211);
      END_STATE();
    case 194:
      if (lookahead == '_') ADVANCE(212);
      END_STATE();
    case 195:
      if (lookahead == 'i') ADVANCE(213);
      END_STATE();
    case 196:
      if (lookahead == 'd') ADVANCE(83);
      END_STATE();
    case 197:
      if (lookahead == 'a') ADVANCE(214);
      END_STATE();
    case 198:
      if (lookahead == 'n') ADVANCE(215);
      END_STATE();
    case 199:
      if (lookahead == 'l') ADVANCE(216);
      END_STATE();
    case 200:
      if (lookahead == 'i') ADVANCE(217);
      END_STATE();
    case 201:
      if (lookahead == '_') ADVANCE(218);
      END_STATE();
    case 202:
      if (lookahead == '_') ADVANCE(219);
      END_STATE();
    case 203:
      if (lookahead == 'n') ADVANCE(220);
      END_STATE();
    case 204:
      if (lookahead == 't') ADVANCE(221);
      END_STATE();
    case 205:
      if (lookahead == 't') ADVANCE(222);
      END_STATE();
    case 206:
      if (lookahead == 'i') ADVANCE(223);
      END_STATE();
    case 207:
      if (lookahead == 't') ADVANCE(224);
      END_STATE();
    case 208:
      if (lookahead == 's') ADVANCE(83);
      END_STATE();
    case 209:
      if (lookahead == '_') ADVANCE(225);
      END_STATE();
    case 210:
      if (lookahead == '_') ADVANCE(226);
      END_STATE();
    case 211:
      if (lookahead == '1' ||
          lookahead == '2') ADVANCE(83);
      END_STATE();
    case 212:
      if (lookahead == 'r') ADVANCE(227);
      END_STATE();
    case 213:
      if (lookahead == 'n') ADVANCE(228);
      END_STATE();
    case 214:
      if (lookahead == 't') ADVANCE(229);
      END_STATE();
    case 215:
      if (lookahead == 'd') ADVANCE(83);
      END_STATE();
    case 216:
      if (lookahead == 'e') ADVANCE(60);
      END_STATE();
    case 217:
      if (lookahead == 'l') ADVANCE(230);
      END_STATE();
    case 218:
      if (lookahead == 'c') ADVANCE(231);
      END_STATE();
    case 219:
      if (lookahead == 'd') ADVANCE(232);
      END_STATE();
    case 220:
      if (lookahead == 'n') ADVANCE(60);
      END_STATE();
    case 221:
      ACCEPT_TOKEN(sym_command_word);
      if (lookahead == '_') ADVANCE(233);
      END_STATE();
    case 222:
      if (lookahead == 'r') ADVANCE(234);
      END_STATE();
    case 223:
      if (lookahead == 'o') ADVANCE(235);
      END_STATE();
    case 224:
      if (lookahead == '_') ADVANCE(236);
      END_STATE();
    case 225:
      if (lookahead == 's') ADVANCE(237);
      END_STATE();
    case 226:
      if (lookahead == 's') ADVANCE(238);
      END_STATE();
    case 227:
      if (lookahead == 'a') ADVANCE(239);
      END_STATE();
    case 228:
      if (lookahead == 'g') ADVANCE(83);
      END_STATE();
    case 229:
      if (lookahead == 'i') ADVANCE(240);
      END_STATE();
    case 230:
      if (lookahead == '_') ADVANCE(241);
      END_STATE();
    case 231:
      if (lookahead == 'o') ADVANCE(242);
      END_STATE();
    case 232:
      if (lookahead == 'r') ADVANCE(243);
      END_STATE();
    case 233:
      if (lookahead == 's') ADVANCE(244);
      END_STATE();
    case 234:
      if (lookahead == 'o') ADVANCE(245);
      END_STATE();
    case 235:
      if (lookahead == 'n') ADVANCE(83);
      END_STATE();
    case 236:
      if (lookahead == 'r') ADVANCE(246);
      END_STATE();
    case 237:
      if (lookahead == 'd') ADVANCE(247);
      END_STATE();
    case 238:
      if (lookahead == 'd') ADVANCE(248);
      END_STATE();
    case 239:
      if (lookahead == 't') ADVANCE(249);
      END_STATE();
    case 240:
      if (lookahead == 'o') ADVANCE(250);
      END_STATE();
    case 241:
      if (lookahead == 's') ADVANCE(251);
      END_STATE();
    case 242:
      if (lookahead == 'l') ADVANCE(252);
      END_STATE();
    case 243:
      if (lookahead == 'v') ADVANCE(60);
      END_STATE();
    case 244:
      if (lookahead == 'y') ADVANCE(253);
      END_STATE();
    case 245:
      if (lookahead == 'l') ADVANCE(60);
      END_STATE();
    case 246:
      if (lookahead == 'e') ADVANCE(254);
      END_STATE();
    case 247:
      if (lookahead == '1') ADVANCE(83);
      END_STATE();
    case 248:
      if (lookahead == '1') ADVANCE(83);
      END_STATE();
    case 249:
      if (lookahead == 'e') ADVANCE(83);
      END_STATE();
    case 250:
      if (lookahead == 'n') ADVANCE(83);
      END_STATE();
    case 251:
      if (lookahead == 't') ADVANCE(255);
      END_STATE();
    case 252:
      if (lookahead == 'l') ADVANCE(256);
      END_STATE();
    case 253:
      if (lookahead == 's') ADVANCE(257);
      END_STATE();
    case 254:
      if (lookahead == 's') ADVANCE(258);
      END_STATE();
    case 255:
      if (lookahead == 'o') ADVANCE(259);
      END_STATE();
    case 256:
      if (lookahead == 'i') ADVANCE(260);
      END_STATE();
    case 257:
      if (lookahead == 't') ADVANCE(261);
      END_STATE();
    case 258:
      if (lookahead == 'e') ADVANCE(262);
      END_STATE();
    case 259:
      if (lookahead == 'p') ADVANCE(263);
      END_STATE();
    case 260:
      if (lookahead == 's') ADVANCE(264);
      END_STATE();
    case 261:
      if (lookahead == 'e') ADVANCE(265);
      END_STATE();
    case 262:
      if (lookahead == 't') ADVANCE(60);
      END_STATE();
    case 263:
      if (lookahead == 'p') ADVANCE(266);
      END_STATE();
    case 264:
      if (lookahead == 'i') ADVANCE(267);
      END_STATE();
    case 265:
      if (lookahead == 'm') ADVANCE(83);
      END_STATE();
    case 266:
      if (lookahead == 'e') ADVANCE(268);
      END_STATE();
    case 267:
      if (lookahead == 'o') ADVANCE(269);
      END_STATE();
    case 268:
      if (lookahead == 'd') ADVANCE(83);
      END_STATE();
    case 269:
      if (lookahead == 'n') ADVANCE(83);
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
  [14] = {.lex_state = 0},
  [15] = {.lex_state = 0},
  [16] = {.lex_state = 0},
  [17] = {.lex_state = 0},
  [18] = {.lex_state = 0},
  [19] = {.lex_state = 0},
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
};

static const uint16_t ts_parse_table[LARGE_STATE_COUNT][SYMBOL_COUNT] = {
  [0] = {
    [ts_builtin_sym_end] = ACTIONS(1),
    [sym_word] = ACTIONS(1),
    [aux_sym_program_token1] = ACTIONS(1),
    [sym__line_end] = ACTIONS(1),
    [anon_sym_COMMA] = ACTIONS(1),
    [anon_sym_EQ] = ACTIONS(1),
    [sym_directive_word] = ACTIONS(1),
    [sym_command_word] = ACTIONS(1),
    [sym_value_word] = ACTIONS(1),
    [sym_number] = ACTIONS(1),
    [sym_string] = ACTIONS(1),
    [sym_comment] = ACTIONS(1),
  },
  [1] = {
    [sym_program] = STATE(29),
    [sym__line] = STATE(26),
    [sym_directive] = STATE(22),
    [sym_command] = STATE(22),
    [aux_sym_program_repeat1] = STATE(10),
    [ts_builtin_sym_end] = ACTIONS(3),
    [aux_sym_program_token1] = ACTIONS(5),
    [sym__line_end] = ACTIONS(7),
    [sym_directive_word] = ACTIONS(9),
    [sym_command_word] = ACTIONS(11),
    [sym_comment] = ACTIONS(13),
  },
  [2] = {
    [sym__operand] = STATE(3),
    [sym_operand] = STATE(3),
    [sym__value] = STATE(3),
    [aux_sym__operands_repeat1] = STATE(3),
    [ts_builtin_sym_end] = ACTIONS(15),
    [sym_word] = ACTIONS(17),
    [sym__line_end] = ACTIONS(15),
    [anon_sym_COMMA] = ACTIONS(19),
    [sym_command_word] = ACTIONS(21),
    [sym_value_word] = ACTIONS(23),
    [sym_number] = ACTIONS(25),
    [sym_string] = ACTIONS(25),
    [sym_comment] = ACTIONS(15),
  },
  [3] = {
    [sym__operand] = STATE(4),
    [sym_operand] = STATE(4),
    [sym__value] = STATE(4),
    [aux_sym__operands_repeat1] = STATE(4),
    [ts_builtin_sym_end] = ACTIONS(27),
    [sym_word] = ACTIONS(17),
    [sym__line_end] = ACTIONS(27),
    [anon_sym_COMMA] = ACTIONS(19),
    [sym_command_word] = ACTIONS(21),
    [sym_value_word] = ACTIONS(23),
    [sym_number] = ACTIONS(29),
    [sym_string] = ACTIONS(29),
    [sym_comment] = ACTIONS(27),
  },
  [4] = {
    [sym__operand] = STATE(4),
    [sym_operand] = STATE(4),
    [sym__value] = STATE(4),
    [aux_sym__operands_repeat1] = STATE(4),
    [ts_builtin_sym_end] = ACTIONS(31),
    [sym_word] = ACTIONS(33),
    [sym__line_end] = ACTIONS(31),
    [anon_sym_COMMA] = ACTIONS(36),
    [sym_command_word] = ACTIONS(39),
    [sym_value_word] = ACTIONS(42),
    [sym_number] = ACTIONS(45),
    [sym_string] = ACTIONS(45),
    [sym_comment] = ACTIONS(31),
  },
  [5] = {
    [sym__operands] = STATE(23),
    [sym__operand] = STATE(2),
    [sym_operand] = STATE(2),
    [sym__value] = STATE(2),
    [ts_builtin_sym_end] = ACTIONS(48),
    [sym_word] = ACTIONS(17),
    [sym__line_end] = ACTIONS(48),
    [sym_command_word] = ACTIONS(21),
    [sym_value_word] = ACTIONS(23),
    [sym_number] = ACTIONS(50),
    [sym_string] = ACTIONS(50),
    [sym_comment] = ACTIONS(48),
  },
  [6] = {
    [sym__operands] = STATE(24),
    [sym__operand] = STATE(2),
    [sym_operand] = STATE(2),
    [sym__value] = STATE(2),
    [ts_builtin_sym_end] = ACTIONS(52),
    [sym_word] = ACTIONS(17),
    [sym__line_end] = ACTIONS(52),
    [sym_command_word] = ACTIONS(21),
    [sym_value_word] = ACTIONS(23),
    [sym_number] = ACTIONS(50),
    [sym_string] = ACTIONS(50),
    [sym_comment] = ACTIONS(52),
  },
};

static const uint16_t ts_small_parse_table[] = {
  [0] = 3,
    ACTIONS(58), 1,
      anon_sym_EQ,
    ACTIONS(56), 3,
      sym_command_word,
      sym_value_word,
      sym_word,
    ACTIONS(54), 6,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_COMMA,
      sym_number,
      sym_string,
      sym_comment,
  [17] = 3,
    ACTIONS(58), 1,
      anon_sym_EQ,
    ACTIONS(62), 3,
      sym_command_word,
      sym_value_word,
      sym_word,
    ACTIONS(60), 6,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_COMMA,
      sym_number,
      sym_string,
      sym_comment,
  [34] = 3,
    ACTIONS(64), 1,
      anon_sym_EQ,
    ACTIONS(56), 3,
      sym_command_word,
      sym_value_word,
      sym_word,
    ACTIONS(54), 6,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_COMMA,
      sym_number,
      sym_string,
      sym_comment,
  [51] = 8,
    ACTIONS(9), 1,
      sym_directive_word,
    ACTIONS(11), 1,
      sym_command_word,
    ACTIONS(66), 1,
      ts_builtin_sym_end,
    ACTIONS(68), 1,
      sym__line_end,
    ACTIONS(70), 1,
      sym_comment,
    STATE(15), 1,
      aux_sym_program_repeat1,
    STATE(25), 1,
      sym__line,
    STATE(22), 2,
      sym_directive,
      sym_command,
  [77] = 8,
    ACTIONS(9), 1,
      sym_directive_word,
    ACTIONS(11), 1,
      sym_command_word,
    ACTIONS(68), 1,
      sym__line_end,
    ACTIONS(72), 1,
      ts_builtin_sym_end,
    ACTIONS(74), 1,
      sym_comment,
    STATE(15), 1,
      aux_sym_program_repeat1,
    STATE(28), 1,
      sym__line,
    STATE(22), 2,
      sym_directive,
      sym_command,
  [103] = 8,
    ACTIONS(9), 1,
      sym_directive_word,
    ACTIONS(11), 1,
      sym_command_word,
    ACTIONS(66), 1,
      ts_builtin_sym_end,
    ACTIONS(70), 1,
      sym_comment,
    ACTIONS(76), 1,
      sym__line_end,
    STATE(11), 1,
      aux_sym_program_repeat1,
    STATE(25), 1,
      sym__line,
    STATE(22), 2,
      sym_directive,
      sym_command,
  [129] = 2,
    ACTIONS(62), 3,
      sym_command_word,
      sym_value_word,
      sym_word,
    ACTIONS(60), 6,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_COMMA,
      sym_number,
      sym_string,
      sym_comment,
  [143] = 2,
    ACTIONS(80), 3,
      sym_command_word,
      sym_value_word,
      sym_word,
    ACTIONS(78), 6,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_COMMA,
      sym_number,
      sym_string,
      sym_comment,
  [157] = 8,
    ACTIONS(82), 1,
      ts_builtin_sym_end,
    ACTIONS(84), 1,
      sym__line_end,
    ACTIONS(87), 1,
      sym_directive_word,
    ACTIONS(90), 1,
      sym_command_word,
    ACTIONS(93), 1,
      sym_comment,
    STATE(15), 1,
      aux_sym_program_repeat1,
    STATE(30), 1,
      sym__line,
    STATE(22), 2,
      sym_directive,
      sym_command,
  [183] = 2,
    ACTIONS(98), 3,
      sym_command_word,
      sym_value_word,
      sym_word,
    ACTIONS(96), 6,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_COMMA,
      sym_number,
      sym_string,
      sym_comment,
  [197] = 2,
    ACTIONS(100), 3,
      sym_command_word,
      sym_value_word,
      sym_word,
    ACTIONS(31), 6,
      ts_builtin_sym_end,
      sym__line_end,
      anon_sym_COMMA,
      sym_number,
      sym_string,
      sym_comment,
  [211] = 5,
    ACTIONS(17), 1,
      sym_word,
    ACTIONS(21), 1,
      sym_command_word,
    ACTIONS(23), 1,
      sym_value_word,
    ACTIONS(102), 2,
      sym_number,
      sym_string,
    STATE(17), 3,
      sym__operand,
      sym_operand,
      sym__value,
  [230] = 4,
    ACTIONS(106), 1,
      sym_command_word,
    STATE(16), 1,
      sym__value,
    ACTIONS(104), 2,
      sym_value_word,
      sym_word,
    ACTIONS(108), 2,
      sym_number,
      sym_string,
  [245] = 4,
    ACTIONS(106), 1,
      sym_command_word,
    STATE(14), 1,
      sym__value,
    ACTIONS(110), 2,
      sym_value_word,
      sym_word,
    ACTIONS(112), 2,
      sym_number,
      sym_string,
  [260] = 1,
    ACTIONS(82), 5,
      ts_builtin_sym_end,
      sym__line_end,
      sym_directive_word,
      sym_command_word,
      sym_comment,
  [268] = 2,
    ACTIONS(116), 1,
      sym_comment,
    ACTIONS(114), 2,
      ts_builtin_sym_end,
      sym__line_end,
  [276] = 1,
    ACTIONS(118), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
  [282] = 1,
    ACTIONS(120), 3,
      ts_builtin_sym_end,
      sym__line_end,
      sym_comment,
  [288] = 2,
    ACTIONS(72), 1,
      ts_builtin_sym_end,
    ACTIONS(122), 1,
      sym__line_end,
  [295] = 2,
    ACTIONS(66), 1,
      ts_builtin_sym_end,
    ACTIONS(122), 1,
      sym__line_end,
  [302] = 1,
    ACTIONS(124), 2,
      ts_builtin_sym_end,
      sym__line_end,
  [307] = 2,
    ACTIONS(122), 1,
      sym__line_end,
    ACTIONS(126), 1,
      ts_builtin_sym_end,
  [314] = 1,
    ACTIONS(128), 1,
      ts_builtin_sym_end,
  [318] = 1,
    ACTIONS(122), 1,
      sym__line_end,
};

static const uint32_t ts_small_parse_table_map[] = {
  [SMALL_STATE(7)] = 0,
  [SMALL_STATE(8)] = 17,
  [SMALL_STATE(9)] = 34,
  [SMALL_STATE(10)] = 51,
  [SMALL_STATE(11)] = 77,
  [SMALL_STATE(12)] = 103,
  [SMALL_STATE(13)] = 129,
  [SMALL_STATE(14)] = 143,
  [SMALL_STATE(15)] = 157,
  [SMALL_STATE(16)] = 183,
  [SMALL_STATE(17)] = 197,
  [SMALL_STATE(18)] = 211,
  [SMALL_STATE(19)] = 230,
  [SMALL_STATE(20)] = 245,
  [SMALL_STATE(21)] = 260,
  [SMALL_STATE(22)] = 268,
  [SMALL_STATE(23)] = 276,
  [SMALL_STATE(24)] = 282,
  [SMALL_STATE(25)] = 288,
  [SMALL_STATE(26)] = 295,
  [SMALL_STATE(27)] = 302,
  [SMALL_STATE(28)] = 307,
  [SMALL_STATE(29)] = 314,
  [SMALL_STATE(30)] = 318,
};

static const TSParseActionEntry ts_parse_actions[] = {
  [0] = {.entry = {.count = 0, .reusable = false}},
  [1] = {.entry = {.count = 1, .reusable = false}}, RECOVER(),
  [3] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 0, 0, 0),
  [5] = {.entry = {.count = 1, .reusable = true}}, SHIFT(12),
  [7] = {.entry = {.count = 1, .reusable = true}}, SHIFT(10),
  [9] = {.entry = {.count = 1, .reusable = true}}, SHIFT(5),
  [11] = {.entry = {.count = 1, .reusable = true}}, SHIFT(6),
  [13] = {.entry = {.count = 1, .reusable = true}}, SHIFT(26),
  [15] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__operands, 1, 0, 0),
  [17] = {.entry = {.count = 1, .reusable = false}}, SHIFT(9),
  [19] = {.entry = {.count = 1, .reusable = true}}, SHIFT(18),
  [21] = {.entry = {.count = 1, .reusable = false}}, SHIFT(8),
  [23] = {.entry = {.count = 1, .reusable = false}}, SHIFT(7),
  [25] = {.entry = {.count = 1, .reusable = true}}, SHIFT(3),
  [27] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__operands, 2, 0, 0),
  [29] = {.entry = {.count = 1, .reusable = true}}, SHIFT(4),
  [31] = {.entry = {.count = 1, .reusable = true}}, REDUCE(aux_sym__operands_repeat1, 2, 0, 0),
  [33] = {.entry = {.count = 2, .reusable = false}}, REDUCE(aux_sym__operands_repeat1, 2, 0, 0), SHIFT_REPEAT(9),
  [36] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym__operands_repeat1, 2, 0, 0), SHIFT_REPEAT(18),
  [39] = {.entry = {.count = 2, .reusable = false}}, REDUCE(aux_sym__operands_repeat1, 2, 0, 0), SHIFT_REPEAT(8),
  [42] = {.entry = {.count = 2, .reusable = false}}, REDUCE(aux_sym__operands_repeat1, 2, 0, 0), SHIFT_REPEAT(7),
  [45] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym__operands_repeat1, 2, 0, 0), SHIFT_REPEAT(4),
  [48] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_directive, 1, 0, 1),
  [50] = {.entry = {.count = 1, .reusable = true}}, SHIFT(2),
  [52] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_command, 1, 0, 1),
  [54] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__value, 1, 0, 0),
  [56] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym__value, 1, 0, 0),
  [58] = {.entry = {.count = 1, .reusable = true}}, SHIFT(20),
  [60] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__value, 1, 0, 2),
  [62] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym__value, 1, 0, 2),
  [64] = {.entry = {.count = 1, .reusable = true}}, SHIFT(19),
  [66] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 1, 0, 0),
  [68] = {.entry = {.count = 1, .reusable = true}}, SHIFT(15),
  [70] = {.entry = {.count = 1, .reusable = true}}, SHIFT(25),
  [72] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 2, 0, 0),
  [74] = {.entry = {.count = 1, .reusable = true}}, SHIFT(28),
  [76] = {.entry = {.count = 1, .reusable = true}}, SHIFT(11),
  [78] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_operand, 3, 0, 3),
  [80] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_operand, 3, 0, 3),
  [82] = {.entry = {.count = 1, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0),
  [84] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0), SHIFT_REPEAT(15),
  [87] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0), SHIFT_REPEAT(5),
  [90] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0), SHIFT_REPEAT(6),
  [93] = {.entry = {.count = 2, .reusable = true}}, REDUCE(aux_sym_program_repeat1, 2, 0, 0), SHIFT_REPEAT(30),
  [96] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_operand, 3, 0, 4),
  [98] = {.entry = {.count = 1, .reusable = false}}, REDUCE(sym_operand, 3, 0, 4),
  [100] = {.entry = {.count = 1, .reusable = false}}, REDUCE(aux_sym__operands_repeat1, 2, 0, 0),
  [102] = {.entry = {.count = 1, .reusable = true}}, SHIFT(17),
  [104] = {.entry = {.count = 1, .reusable = false}}, SHIFT(16),
  [106] = {.entry = {.count = 1, .reusable = false}}, SHIFT(13),
  [108] = {.entry = {.count = 1, .reusable = true}}, SHIFT(16),
  [110] = {.entry = {.count = 1, .reusable = false}}, SHIFT(14),
  [112] = {.entry = {.count = 1, .reusable = true}}, SHIFT(14),
  [114] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__line, 1, 0, 0),
  [116] = {.entry = {.count = 1, .reusable = true}}, SHIFT(27),
  [118] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_directive, 2, 0, 1),
  [120] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_command, 2, 0, 1),
  [122] = {.entry = {.count = 1, .reusable = true}}, SHIFT(21),
  [124] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym__line, 2, 0, 0),
  [126] = {.entry = {.count = 1, .reusable = true}}, REDUCE(sym_program, 3, 0, 0),
  [128] = {.entry = {.count = 1, .reusable = true}},  ACCEPT_INPUT(),
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

TS_PUBLIC const TSLanguage *tree_sitter_orbmacro(void) {
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
    .keyword_capture_token = sym_word,
    .primary_state_ids = ts_primary_state_ids,
  };
  return &language;
}
#ifdef __cplusplus
}
#endif
