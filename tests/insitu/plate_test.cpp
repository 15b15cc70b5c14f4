#include "insitu/rod_pictures.hpp"

namespace ejecta {
namespace {

TEST(Tensors, OfAPlateAreShown) { expect_pictures_of_tensors<2>(150); }

}  // namespace
}  // namespace ejecta
