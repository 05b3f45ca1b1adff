// Signals that tell a program to end in good order: from a user, a terminal that goes away, a batch system, a limit.
#pragma once

#include <csignal>

namespace undex {

struct EndSignal {
  int number;
  const char* name;
  bool insists;  ///< sent again it means "at once"; batch systems, limits and dying terminals repeat the others by themselves
};

inline constexpr EndSignal end_signals[] = {{SIGINT, "SIGINT", true},    {SIGTERM, "SIGTERM", true},  {SIGQUIT, "SIGQUIT", true},
                                            {SIGHUP, "SIGHUP", false},   {SIGUSR1, "SIGUSR1", false}, {SIGUSR2, "SIGUSR2", false},
                                            {SIGALRM, "SIGALRM", false}, {SIGXCPU, "SIGXCPU", false}};

inline EndSignal end_signal(int number) {
  for (const EndSignal& signal : end_signals)
    if (signal.number == number) return signal;
  return {number, "a signal", true};
}

/// Has `handler` called for each of them; where `second_kills` a second one that insists kills instead. A SIGHUP that nohup has
/// had ignored stays so.
inline void catch_end_signals(void (*handler)(int), bool second_kills) {
  for (const EndSignal& signal : end_signals) {
    struct sigaction action {};
    if (signal.number == SIGHUP && sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART | (second_kills && signal.insists ? static_cast<int>(SA_RESETHAND) : 0);
    sigaction(signal.number, &action, nullptr);
  }
}

}  // namespace undex
