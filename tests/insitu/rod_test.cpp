#include "insitu/rod_pictures.hpp"

namespace ejecta {
namespace {

TEST(Tensors, OfARodAreShown) { expect_pictures_of_tensors<3>(60); }

}  // namespace
}  // namespace ejecta
