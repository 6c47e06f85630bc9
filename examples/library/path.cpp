// Runs a program on a ball in this process and reads its path.
#include <orb/run/run.h>

#include <cstdio>

namespace {

// Hears what the program prints and where it fails, while it runs.
class Prints final : public orb::run::Listener {
public:
  void on_event(orb::Duration, const orb::vm::Event& event) override {
    if (const auto* print = std::get_if<orb::vm::event::Print>(&event))
      std::fputs(print->text.c_str(), stdout);
  }
  void on_fault(orb::Duration, const orb::run::ProgramError& fault) override {
    std::printf("line %u of %s failed\n", fault.place.line, fault.file.c_str());
  }
};

} // namespace

int main() {
  orb::structured::NoFiles files; // the program includes none
  const auto input = orb::run::read_input("drive.bas",
                                          "10 goroll 0, 100, 1\n"
                                          "20 delay 2000\n"
                                          "30 goroll 0, 0, 0\n"
                                          "40 print \"there\"\n",
                                          "", {}, files);
  if (!input || input->has_errors())
    return 1;

  Prints prints;
  orb::report::Journey journey;
  orb::run::Options options;
  options.until = orb::run::Until::Rest;
  const auto ending = orb::run::run({&*input, 1}, options, prints, &journey);
  if (!ending)
    return 1;
  for (const auto& [t, pose] : journey.poses().entries())
    std::printf("%.2f s: %.0f,%.0f cm\n", std::chrono::duration<double>(t).count(), pose.x_cm,
                pose.y_cm);
  std::puts(story(*ending).c_str());
  return ending->sight.pose.y_cm > 50 ? 0 : 1;
}
