#include "vm/machine/programs.h"

#include <algorithm>

namespace orb::vm {

Programs::Programs(const ProgramOptions& options, std::uint64_t seed)
    : options_(options), machine_(options.lines_per_second, seed, options.dispatch, options.native,
                                  options.native_programs) {
  if (options_.trace_lines)
    machine_.trace_lines();
  machine_.set_ranges(options_.ranges);
  machine_.ask(options_.gate);
}

Outcome Programs::erase(Area area) {
  if (running(area))
    return Outcome::Refused;
  text_[static_cast<std::size_t>(area)].clear();
  return Outcome::Done;
}

Outcome Programs::append(Area area, ByteView text) {
  if (running(area))
    return Outcome::Refused;
  auto& stored = text_[static_cast<std::size_t>(area)];
  if (stored.ends_with('\0'))
    return Outcome::Done;
  const auto end = std::find(text.begin(), text.end(), std::uint8_t{0});
  const auto kept = as_text({text.begin(), end == text.end() ? end : end + 1});
  const std::size_t room = area == Area::Ram
                               ? options_.ram_bytes
                               : static_cast<std::size_t>(spec::value_of(spec::Limit::FlashBytes));
  if (stored.size() + kept.size() > room)
    return Outcome::Refused;
  stored += kept;
  return Outcome::Done;
}

Outcome Programs::commit() {
  if (running(Area::Flash))
    return Outcome::Refused;
  text_[1] = text_[0];
  return Outcome::Done;
}

Outcome Programs::execute(Area area, int line, Instant now) {
  if (running())
    return Outcome::Refused;
  auto program = text(area);
  if (program.ends_with('\0'))
    program.remove_suffix(1);
  area_ = area;
  flags_ = 0;
  machine_.start(options_.loader ? options_.loader(program, options_.language) : bytecode::Chunk{},
                 line, now);
  return Outcome::Done;
}

bool Programs::answer_input(Instant now) {
  if (inputs_.empty() || !machine_.waits_for_input())
    return false;
  deliver(inputs_.front(), now);
  inputs_.pop_front();
  return true;
}

bool Programs::waits_in_vain() const {
  return machine_.waits_for_input() && machine_.next_event() == never && inputs_.empty();
}

Instant Programs::run(Instant limit, Host& host) {
  machine_.run(limit, host);
  return machine_.now();
}

} // namespace orb::vm
