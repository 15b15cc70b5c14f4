#include "schemes/pair_pass.hpp"

#include <type_traits>

#include "base/errors.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

/// Defined in sources of their own that EjectaPairPasses.cmake makes: one for each kernel, dimension and kind.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_isotropic_pass_of(const PairPassSettings& settings);
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_anisotropic_pass_of(const PairPassSettings& settings);
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_riemann_pass_of(const PairPassSettings& settings);

template <int Dim>
std::unique_ptr<PairPass<Dim>> make_pair_pass(const PairPassSettings& settings) {
  return with_kernel(settings.kernel, [&](auto kernel) {
    using K = decltype(kernel);
    if (settings.godunov) return make_riemann_pass_of<Dim, K>(settings);
    if constexpr (std::is_same_v<K, Gaussian>)
      throw InputError("numerics.kernel: expected another one than gaussian, which is for Riemann problems alone");
    else
      return settings.asph || settings.cracked ? make_anisotropic_pass_of<Dim, K>(settings)
                                               : make_isotropic_pass_of<Dim, K>(settings);
  });
}

template std::unique_ptr<PairPass<2>> make_pair_pass<2>(const PairPassSettings&);
template std::unique_ptr<PairPass<3>> make_pair_pass<3>(const PairPassSettings&);

}  // namespace ejecta
