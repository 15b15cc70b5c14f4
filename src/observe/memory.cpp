#include "observe/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace ejecta {

double memory_now() {
  std::ifstream pages("/proc/self/statm");
  double all = 0, resident = 0;
  pages >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double memory_peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace ejecta
