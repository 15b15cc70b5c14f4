#include "scene/describe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/every.hpp"

namespace ejecta {

namespace {

void describe(Describer& d, Profile& p) {
  d.texts("displacement", p.displacement, "m; moves particles from their lattice places, masses stay");
  d.texts("velocity", p.velocity, "m/s");
  d.text("density", p.density, "kg/m^3");
  d.text("pressure", p.pressure, "Pa; of a gas");
  d.text("specific_energy", p.specific_energy, "J/kg");
  d.texts("deviatoric_stress", p.deviatoric_stress, "Pa; xx, yy, xy, in 3D also xz, yz");
}

}  // namespace

void describe(Describer& d, Body& b) {
  d.text("name", b.name, "how messages, --set and the images call the body").required = true;
  d.text("material", b.material, "name of materials/<material>.toml").required = true;
  d.choice("shape", b.shape, "disc and rectangle in 2D, the others in 3D");
  d.triple("center", b.center, "m", "centre of the shape");
  d.number("radius", b.radius, "m", positive, "of a sphere, disc or cylinder");
  d.number("inner_radius", b.inner_radius, "m", non_negative, "of the hole in a sphere, disc or cylinder");
  d.triple("size", b.size, "m", "edge lengths of a box or rectangle");
  d.number("length", b.length, "m", positive, "of a cylinder, along its axis");
  d.triple("axis", b.axis, "1", "direction of a cylinder's axis");
  d.triple("velocity", b.velocity, "m/s", "at the start");
  d.number("density", b.density, "kg/m^3", positive, "at the start, pores included; else the material's own");
  d.number("pressure", b.pressure, "Pa", non_negative, "of a gas at the start; sets its specific energy");
  d.number("specific_energy", b.specific_energy, "J/kg", any_number, "at the start, where no pressure is given");
  d.number("spacing_factor", b.spacing_factor, "1", positive, "particle spacing relative to resolution.spacing");
  d.choice("lattice", b.lattice,
           "how its particles are laid; auto: as resolution.lattice says; shells: of round bodies, in shells between "
           "their faces, so that no rows of a lattice show");
  d.number("aspect", b.aspect, "1", at_least(1),
           "of shells: edge of a particle along its shell over that across; with asph H begins so");
  d.text("weld", b.weld,
         "name of a body it is one piece with; \"none\"; \"auto\": a driven body holds those of its material");
  d.flag("driven", b.driven, "keeps its velocity whatever pulls at it, and never breaks: a grip or a piston");
  d.number("jitter", b.jitter, "1", between(0, 1), "random displacement along each axis, up to this many spacings");
  d.origin(b.origin);
  d.section("profile",
            "formulas of x, y, z, r (from its centre), dx (spacing) and pi in SI, in place of its uniform values");
  describe(d, b.profile);
}

void describe(Describer& d, Detonator& t) {
  d.choice("shape", t.shape, "what is lit at once; in plane strain a point stands for a line along z");
  d.triple("position", t.position, "m", "the point, one end of the line, or a point of the plane").required = true;
  d.triple("end", t.end, "m", "the other end of a line");
  d.triple("normal", t.normal, "1",
           "of a plane; [0, 0, 1] in 2D: a detonation along z passes the whole section at once");
  d.number("time", t.time, "s", non_negative, "when it goes off");
  d.origin(t.origin);
}

void describe(Describer& d, Charge& c) {
  d.triple("center", c.center, "m", "its centre");
  d.number("radius", c.radius, "m", positive, "of the charge").required = true;
  d.number("density", c.density, "kg/m^3", positive, "of the charge").required = true;
  d.number("energy_per_length", c.energy_per_length, "J/m", positive, "in 2D: of a cylinder, as internal energy");
  d.number("energy", c.energy, "J", positive, "in 3D: internal energy of the whole ball");
  d.text("material", c.material, "else that of the gas around it");
  d.number("start", c.start, "s", non_negative,
           "the run begins then, with what a solution in one dimension says; 0: with the charge itself; else, where "
           "there is room, when the shock has come 16 spacings, at the latest at the first of output.times and after a "
           "tenth of the run");
}

void describe(Describer& d, Gas& g) {
  d.text("material", g.material, "name of materials/<material>.toml");
  d.number("gamma", g.gamma, "1", {.min = 1, .open_min = true},
           "ratio of specific heats, in place of the material's own");
  d.number("density", g.density, "kg/m^3", positive, "at the start; else the material's own");
  d.number("pressure", g.pressure, "Pa", positive, "at the start").required = true;
}

void describe(Describer& d, Numerics& n) {
  d.choice("scheme", n.scheme,
           "particles smoothed over a length h (sph) or a tensor H (asph, ellipsoids); the same with Riemann problems "
           "between neighbours, for gases (gsph, agsph); fvm: finite volumes on a grid; hybrid: the same, with gsph "
           "where shocks are");
  d.choice("kernel", n.kernel, "smoothing kernel; gaussian, cut off at 3 h: gsph and hybrid alone");
  d.choice("precision", n.precision, "of the pair passes; mixed: pair differences in float, sums and states in double");
  d.choice("density", n.density,
           "continuity for solids; summation for gases only; gsph: summation unless given, or continuity by what faces "
           "sweep");
  d.number("nodes_per_h", n.nodes_per_h, "1", between(1, 4), "particles per smoothing length");
  d.number("smoothing_growth", n.smoothing_growth, "1", at_least(1),
           "of solids: largest h relative to that of the lattice; 1: h constant. A gas may widen it 20 times");
  d.number("largest_aspect", n.largest_aspect, "1", at_least(1),
           "asph: longest over shortest axis of a smoothing ellipsoid");
  d.integer("shape_interval", n.shape_interval, at_least(1),
            "asph: steps between votes on the shape of H, which moves with the flow between them");
  d.choice("gradient_correction", n.gradient_correction,
           "gradients exact for linear fields, forces their adjoint; auto: unless all is gas");
  d.choice("balsara", n.balsara,
           "shear switch on the viscosity, which leaves turning matter undamped; auto: unless all is gas");
  d.choice("shock_switch", n.shock_switch,
           "no viscosity in smooth flow, where no shock has come by; auto: unless all is gas");
  d.choice("bonds", n.bonds,
           "elastic matter keeps the neighbours of the start; auto: where it bears strains above a twentieth");
  d.number("viscosity_alpha", n.viscosity_alpha, "1", non_negative, "linear coefficient of Monaghan's viscosity");
  d.number("viscosity_beta", n.viscosity_beta, "1", non_negative, "quadratic coefficient of Monaghan's viscosity");
  d.choice("riemann", n.riemann, "gsph: solution of the Riemann problem of a pair, in one go or to round-off");
  d.choice("limiter", n.limiter,
           "gsph: of the slopes that bring states to the middle of a pair; none: first order, as they are");
  d.choice("faces", n.faces,
           "gsph: what fluxes go through, gradients that are exact for linear fields or those of the kernel");
  d.choice("fill_space", n.fill_space,
           "gsph: volumes by the number of neighbours are moved until they fill space, which keeps contacts between "
           "particles of different sizes sharp; auto: with summed densities, but for hybrid or a pilot_width");
  d.number("pilot_width", n.pilot_width, "1", between(1, 4),
           "gsph: smoothing lengths follow a density that is summed over a kernel so many times as wide (2.5 of Puri & "
           "Ramachandran 2014); else neighbours are counted");
  d.number("linear_conduction", n.linear_conduction, "1", between(0, 1),
           "gsph: g1 of an artificial conduction of heat by g1 h c + g2 h^2 (|div v| - div v)");
  d.number("quadratic_conduction", n.quadratic_conduction, "1", between(0, 1), "gsph: g2 of the same");
  d.number("courant", n.courant, "1", {.min = 0, .max = 1, .open_min = true}, "time step in signal crossings of h");
  d.choice("distension_solver", n.distension_solver, "root finder of the porosity model; the last two for comparison");
  d.number("distension_tolerance", n.distension_tolerance, "1", {.min = 0, .max = 1e-7, .open_min = true},
           "absolute, on the distension; above 1e-7 the damage field oscillates");
  d.number("max_energy_drift", n.max_energy_drift, "1", positive,
           "the run fails beyond this relative drift of total energy");
}

void describe(Describer& d, Boundary& b) {
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t k = 0; k < axes.size(); ++k) {
    BoundaryKind &lower = b.lower[k], &upper = b.upper[k];
    // Echoed once where both are alike, face by face where they are not.
    const auto echoed_if = [&](bool alike, const std::function<std::string()>& word) {
      return [&lower, &upper, alike, word] { return (lower == upper) == alike ? word() : ""; };
    };
    Choice& both = std::get<Choice>(d.choice(axes[k], lower, fmt::format("the two faces across {}", axes[k])).target);
    both.get = echoed_if(true, both.get);
    both.set = [&lower, &upper](std::size_t word) { lower = upper = static_cast<BoundaryKind>(word); };
    for (BoundaryKind* face : {&lower, &upper}) {
      const char* side = face == &lower ? "min" : "max";
      Choice& one = std::get<Choice>(
          d.choice(fmt::format("{}_{}", axes[k], side), *face, fmt::format("one of them alone, at boundary.{}", side))
              .target);
      one.get = echoed_if(false, one.get);
    }
  }
  d.triple("min", b.min, "m", "lower corner of the box; components of open faces do not matter");
  d.triple("max", b.max, "m", "upper corner of the box; components of open faces do not matter");
}

void describe(Describer& d, Contact& c) {
  d.number("friction", c.friction, "1", non_negative, "coefficient, between bodies and on walls; 0: they slide");
}

void describe(Describer& d, Pipeline& p) {
  d.text("script", p.script, "beside the scene or shipped (ellipses.py, damage.py); \"default\": the default ones")
      .required = true;
  d.texts("args", p.args, "what catalyst.get_args() gives to the script");
  d.text("every", p.every,
         "when it is asked, as in insitu.every; else with the frames, or when its own triggers say so");
}

void describe(Describer& d, InSitu& i) {
  d.flag("enabled", i.enabled, "images and statistics while the run goes on");
  d.integer("frames", i.frames, at_least(2), "equally spaced in simulated time, first and last included");
  d.frame_times("times", i.times,
                "of the frames, in place of equal spacing; \"dense early\": at the squares of k / (frames - 1)");
  d.texts("every", i.every,
          "more frames: every so much simulated time (\"2 us\"), steps (\"100 steps\") or wall time (\"30 s wall\")");
  d.texts("events", i.events, fmt::format("more frames when something happens: {}", fmt::join(event_words, ", ")));
  d.integer("burst", i.burst, non_negative, "frames after that of an event, ten times as dense as the others");
  d.flag("column_density", i.column_density, "also draw the mass per area seen along y (view `column`)");
  d.choice("on_error", i.on_error,
           "what becomes of a pipeline that fails after its first frame: it is tried again, left out, or ends the run");
  d.number("max_share", i.max_share, "1", {.min = 0, .max = 1, .open_min = true},
           "frames are left out where they would take more than this share of the wall time; 1: never");
  d.integer("image_width", i.image_width, between(64, 8192), "pixels");
  d.integer("image_height", i.image_height, between(64, 8192), "pixels");
  d.triple("view_center", i.view_center, "m", "middle of the images; else of the bodies that move least");
  d.number("view_size", i.view_size, "m", positive,
           "visible width at least; else 1.6 times the extent of the slowest bodies, 3 times with detonators, and half "
           "as much again for others that begin near");
  d.number("view_height", i.view_height, "m", positive, "visible height at least; else view_size");
  d.map("ranges", i.ranges, "<field>", "field name = fixed colour range",
        [&](const std::string& field, ColourRange& r) {
          d.range(field, r, "same from the first frame to the last").required = true;
        });
  d.list("pipelines", i.pipelines, false,
         "Catalyst scripts, also as a list: pipelines = [\"default\", \"x.py\", {script = \"y.py\", every = \"2 "
         "us\"}]; none: default",
         [&](Pipeline& pipeline) { describe(d, pipeline); });
}

void describe(Describer& d, Probe& p) {
  d.text("name", p.name, "of its table probe_<name>.csv and its figure").required = true;
  d.choice(
      "kind", p.kind,
      "point: fixed in space; tracer: rides on the matter that was there at the start; surface: rides on the matter "
      "that a beam meets first at the start; velocimeter: a beam that sees the first surface it meets");
  d.triple("at", p.at, "m", "where it is at the start; of a surface or velocimeter: where the beam begins").required =
      true;
  d.text("body", p.body, "name of the body that it reads, whatever else is there; else any");
  d.triple("direction", p.direction, "1",
           "of the beam of a surface or velocimeter, whose velocity counts towards its beginning; of the others adds "
           "the velocity "
           "along it, of a tracer also the strain");
  d.number("spot", p.spot, "m", positive, "radius of a beam; else resolution.spacing");
  d.number("range", p.range, "m", positive, "how far a beam sees, such as to the axis of a tube; else without end");
  d.number("window", p.window, "s", non_negative, "values are means over so long before each row; 0: of that moment");
  d.number("interval", p.interval, "s", positive,
           "between rows, each at the first step from then on; else output.history_interval");
  d.text("measured", p.measured,
         "CSV file beside the scene, drawn into the figure: time [s], and columns named as those of the probe");
  d.number("measured_delay", p.measured_delay, "s", any_number, "added to the times of the measured trace");
  d.origin(p.origin);
}

void describe(Describer& d, FragmentTheory& t) {
  d.number("strain_rate", t.strain_rate, "1/s", positive, "of the wall when it breaks: its speed over its radius");
  d.number("thickness", t.thickness, "m", positive, "of the wall when it breaks");
  d.numbers("fracture_energy", t.fracture_energy, "J/m^2", positive, "Grady and Kipp: energy of a new crack");
  d.numbers("flow_stress", t.flow_stress, "Pa", positive, "Mott: yield stress when it breaks");
  d.numbers("mott_gamma", t.mott_gamma, "1", positive, "Mott: one over the scatter of the strain at which it breaks");
}

void describe(Describer& d, FragmentSettings& f) {
  d.flag("enabled", f.enabled, "find connected pieces during the run");
  d.choice("link", f.link, "unit of linking_length: mean particle size, or node spacing of H (auto: that in ASPH)");
  d.number("linking_length", f.linking_length, "1", positive,
           "friends are nearer than this many mean particle sizes, or node spacings of H of either");
  d.number("damage_threshold", f.damage_threshold, "1", at_least(0),
           "particles damaged beyond this are dust; above 1 damage cuts no links");
  d.integer("min_particles", f.min_particles, at_least(1), "smaller groups are dust");
  d.text("target", f.target,
         "name of the body whose pieces and mass all fragment figures refer to; else the heaviest body at rest, or the "
         "slowest about the centre of mass");
  d.text("measured", f.measured,
         "CSV file beside the scene, drawn into the figures: mass [kg] of the fragments that were caught");
  d.section("theory",
            "how a wall that stretches breaks, drawn into the figures: lists of one number, or of both ends of a range",
            [&] { describe(d, f.theory); });
}

void describe(Describer& d, OutputSettings& o) {
  d.number("history_interval", o.history_interval, "s", positive,
           "simulated time between rows of history.csv; else end/200");
  d.number("checkpoint_interval", o.checkpoint_interval, "s", non_negative,
           "wall time between checkpoints, the first of them after a minute; 0: none by wall time")
      .zero_is_unset = true;
  d.number("checkpoint_every", o.checkpoint_every, "s", positive,
           "simulated time between further checkpoints, each at the end of the step that passes it");
  d.integer("checkpoints_kept", o.checkpoints_kept, at_least(1), "so many of the newest stay");
  d.integer("snapshots", o.snapshots, non_negative, "full dumps, equally spaced in simulated time");
  d.numbers("times", o.times, "s", positive,
            "steps end there, with a frame, rows of the tables, a line-out of a grid and a full dump");
  d.flag("peaks", o.peaks, "particles remember peak pressure, peak energy, lowest density and where they come from");
}

void describe(Describer& d, Scene& s, const std::vector<SceneSection>& sections) {
  d.section("scene", "what it is");
  d.text("name", s.name, "names the run folder").required = true;
  d.text("title", s.title, "one line for people");
  d.integer("dimension", s.dimension, between(2, 3), "2: plane strain, masses per metre of depth");
  d.section("resolution", "how fine");
  d.number("spacing", s.spacing, "m", positive, "distance between particles at the start").required = true;
  d.choice("lattice", s.lattice,
           "arrangement of the particles at the start; glass: evenly spread without rows, drawn by random.seed");
  d.section("time", "how long");
  d.number("end", s.time_end, "s", positive, "simulated time at which the run ends").required = true;
  d.integer("max_steps", s.max_steps, non_negative, "ends the run earlier; 0: no limit").zero_is_unset = true;
  const bool blast = s.charge || s.gas;
  d.list("bodies", s.bodies, !blast, "one body, filled at set-up", [&](Body& body) { describe(d, body); });
  d.list("detonators", s.detonators, false, "lights what it touches of the explosives",
         [&](Detonator& detonator) { describe(d, detonator); });
  if (s.charge)
    d.section("charge", "a ball (in 2D a disc) of hot dense gas: its blast is followed",
              [&] { describe(d, *s.charge); });
  if (s.gas) d.section("gas", "fills the boundary box wherever no body is", [&] { describe(d, *s.gas); });
  d.section("numerics", "how the equations are solved");
  describe(d, s.numerics);
  d.section("boundary",
            "faces of a box around everything; what bodies have beyond them is cut off, and behind a periodic one "
            "comes in at the other");
  describe(d, s.boundary);
  d.section("contact", "bodies and walls that touch: they press and part, and slide or rub");
  describe(d, s.contact);
  for (const auto& section : s.sections) {
    const auto about = std::ranges::find(sections, section.first, &SceneSection::name);
    d.section(section.first, about == sections.end() ? "" : about->doc, [&] { section.second->describe(d); });
  }
  d.section("insitu", "pictures while the run goes on", [&] { describe(d, s.insitu); });
  d.section("fragments", "connected pieces and their masses", [&] { describe(d, s.fragments); });
  d.list("probes", s.probes, false, "gauges and velocimeters, read while the run goes on",
         [&](Probe& probe) { describe(d, probe); });
  d.section("output", "files");
  describe(d, s.output);
  d.section("run", "the machine");
  d.integer("threads", s.threads, between(0, 4096),
            "0: all cores; no more than these are taken; never changes the result")
      .zero_is_unset = true;
  d.section("random", "chance");
  d.integer("seed", s.seed, "of the flaws in brittle bodies, of jitter and glass");
}

}  // namespace ejecta
