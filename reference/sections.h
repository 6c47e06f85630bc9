#pragma once

// The chapters of knowledge(), one per table. Called only by reference/knowledge.cpp and the
// editor.

#include "reference/knowledge.h"

namespace orb::reference {

/// Escapes `text` for a cell of a Markdown table.
std::string table_cell(std::string_view text);

Section statements_section();
Section words_section();
Section functions_section();
Section letters_section();
Section colours_section();
Section variables_section();
Section operators_section();
Section basic_errors_section();
Section limits_section();
Section rules_section();
Section basic_flags_section();
Section structured_words_section();
Section structured_rules_section();
Section macro_commands_section();
Section macro_flags_section();
Section macro_limits_section();
Section macro_rules_section();
Section stimulus_section();
Section stimulus_rules_section();
Section course_rules_section();
Section client_rules_section();
Section test_lines_section();
Section expectations_section();
Section test_rules_section();
Section api_commands_section();
Section api_messages_section();
Section responses_section();
Section streams_section();
Section firmwares_section();
Section ball_section();
Section robots_section();
Section robot_commands_section();
Section edu_calls_section();
Section edu_events_section();

} // namespace orb::reference
