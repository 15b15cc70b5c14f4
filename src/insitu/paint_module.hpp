#pragma once

namespace ejecta {

/// Makes Ejecta's own painter (render/) known to Python as the module ejecta_paint. To be called before Python starts;
/// later calls do nothing.
void offer_paint_module();

}  // namespace ejecta
