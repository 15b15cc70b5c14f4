#include "insitu/headless_window.hpp"

namespace ejecta {

void use_headless_window() {}

}  // namespace ejecta
