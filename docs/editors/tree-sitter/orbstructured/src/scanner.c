// Where a line of structured orbBasic ends: outside of brackets a line end ends the statement, but
// not before what can only go on: a sign, a closing bracket, `and` and `or`. (After a comma or a
// sign the grammar asks for no end, and the line end is a blank.)

#include "tree_sitter/parser.h"

enum Token { LINE_END, RECOVERY };

void *tree_sitter_orbstructured_external_scanner_create(void) { return 0; }
void tree_sitter_orbstructured_external_scanner_destroy(void *state) { (void)state; }
unsigned tree_sitter_orbstructured_external_scanner_serialize(void *state, char *buffer) {
  (void)state;
  (void)buffer;
  return 0;
}
void tree_sitter_orbstructured_external_scanner_deserialize(void *state, const char *buffer,
                                                            unsigned length) {
  (void)state;
  (void)buffer;
  (void)length;
}

static bool is_line_end(int32_t c) { return c == '\n' || c == '\r'; }
static bool is_blank(int32_t c) { return c == ' ' || c == '\t'; }
static bool is_letter(int32_t c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
static bool is_name(int32_t c) { return is_letter(c) || c == '_' || (c >= '0' && c <= '9'); }

// Steps over blanks, line ends and comments.
static void skip_gap(TSLexer *lexer) {
  while (is_blank(lexer->lookahead) || is_line_end(lexer->lookahead) || lexer->lookahead == '\'')
    if (lexer->lookahead == '\'')
      while (!lexer->eof(lexer) && !is_line_end(lexer->lookahead))
        lexer->advance(lexer, true);
    else
      lexer->advance(lexer, true);
}

// Whether a word other than `and` and `or` stands here.
static bool is_other_word(TSLexer *lexer) {
  char word[4] = {0};
  unsigned length = 0;
  for (; is_name(lexer->lookahead); lexer->advance(lexer, true), ++length)
    if (length < sizeof word)
      word[length] = (char)(lexer->lookahead | 0x20); // a small letter
  const bool is_and = length == 3 && word[0] == 'a' && word[1] == 'n' && word[2] == 'd';
  const bool is_or = length == 2 && word[0] == 'o' && word[1] == 'r';
  return length > 0 && !is_and && !is_or;
}

bool tree_sitter_orbstructured_external_scanner_scan(void *state, TSLexer *lexer,
                                                     const bool *wanted) {
  (void)state;
  if (!wanted[LINE_END])
    return false;
  while (is_blank(lexer->lookahead))
    lexer->advance(lexer, true);
  lexer->result_symbol = LINE_END;
  if (lexer->eof(lexer))
    return !wanted[RECOVERY]; // the last line may lack its end
  if (!is_line_end(lexer->lookahead))
    return false;
  lexer->advance(lexer, false);
  lexer->mark_end(lexer);
  if (wanted[RECOVERY])
    return true;
  skip_gap(lexer);
  return lexer->eof(lexer) || lexer->lookahead == '?' || is_other_word(lexer);
}
