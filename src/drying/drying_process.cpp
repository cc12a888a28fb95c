#include "drying/drying_process.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <memory>

#include "drying/artist_skin.h"
#include "drying/checkpoint.h"
#include "drying/frame_maker.h"
#include "drying/imperfection.h"
#include "drying/moisture_course.h"
#include "drying/specimen.h"

namespace windfall::drying {

namespace {

// Writing checkpoints takes no more of the time, those of millions of unknowns taking seconds, unless that
// would put too much at risk.
constexpr double kCheckpointShare = 0.02;
constexpr double kLongestWithoutCheckpoint_s = 300;

std::int64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

/// Seconds left from the speed over the last part of the way: drying is quick before the wrinkles come.
class TimeLeft {
  public:
    double estimate(double done, double total, double now_s) {
        constexpr double kWindow = 0.15;  // of the way
        m_points.push_back({done, now_s});
        while (m_points.size() > 2 && m_points[1].done < done - kWindow * total)
            m_points.erase(m_points.begin());
        const double way = done - m_points.front().done;
        return way > 0 ? (total - done) * (now_s - m_points.front().at_s) / way : -1;
    }

  private:
    struct Point {
        double done, at_s;
    };
    std::vector<Point> m_points;
};

class Run {
  public:
    Run(const DryingParameters& parameters, const FruitFiles& files, take::FrameSink& sink,
        const RunContext& context, std::span<const std::byte> checkpoint)
        : m_parameters(parameters),
          m_fruit(files.fruit.get()),
          m_sink(sink),
          m_context(context),
          m_frames(frame_parameters(parameters)),
          m_path(fresh_path(files.paint)) {
        if (on_artist_mesh()) m_artist_skin = std::make_unique<ArtistSkin>(*m_fruit, m_path.mesh());
        if (!checkpoint.empty()) {
            Checkpoint saved =
                checkpoint_from(checkpoint, m_path.elasticity().size(), m_path.state().course.values.size());
            m_frames_done = saved.frames_done;
            m_elapsed_before_s = saved.elapsed_s;
            m_path.set_state(std::move(saved.path));
        }
    }

    void go() {
        if (m_frames_done == 0)
            m_sink.add_mesh(m_artist_skin ? m_artist_skin->take_mesh() : skin_mesh(m_path.mesh()));
        try {
            while (m_frames_done < static_cast<int>(m_frames.size())) {
                m_path.advance(m_frames[m_frames_done], m_context, [this] { after_step(); });
                take::Frame frame = make_frame(m_path, m_parameters, m_frames_done);
                if (m_artist_skin) m_artist_skin->carry(frame);
                m_sink.add_frame(frame);
                ++m_frames_done;
                if (m_frames_done == static_cast<int>(m_frames.size()))
                    save();
                else
                    save_when_due();
            }
        } catch (const Cancelled&) {
            save();
            throw;
        } catch (const LostEquilibrium&) {
            save();
            throw;
        }
    }

  private:
    /// Whether the take has the artist's mesh, not the solver's skin.
    bool on_artist_mesh() const { return m_fruit != nullptr && m_parameters.fruit.uvs == TakeSkin::Own; }

    DryingPath fresh_path(const SkinPaint& paint) {
        m_context.progress({"meshing", 0, m_frames.back(), -1, ""});
        check(m_parameters);
        geometry::LayeredMesh mesh = m_fruit != nullptr
                                         ? make_mesh(m_parameters, *m_fruit)
                                         : make_mesh(m_parameters, *make_shape(m_parameters.fruit));
        add_imperfection(mesh, m_parameters, m_context);
        if (!m_parameters.moisture.on()) return {std::move(mesh), m_parameters};
        DryingParameters real = m_parameters;
        if (m_fruit != nullptr) real.fruit.size_m = real.fruit.unit_m * m_fruit->r1();
        auto course = std::make_unique<MoistureCourse>(mesh, real, exposure_of(mesh, paint));
        return {std::move(mesh), m_parameters, std::move(course)};
    }

    SkinExposure exposure_of(const geometry::LayeredMesh& mesh, const SkinPaint& paint) const {
        std::vector<geometry::Vec2> uvs;
        if (paint) uvs = on_artist_mesh() ? m_fruit->uvs_under(mesh) : atlas_middles(mesh.brick);
        return skin_exposure(mesh, m_parameters.moisture, paint, uvs);
    }

    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    }

    void after_step() {
        const StepRecord& step = m_path.state().history.back();
        const double total = m_frames.back();
        const bool rewetting = !m_parameters.moisture.on() && step.parameter > m_parameters.drying.shrinkage;
        m_context.progress({rewetting ? "rewetting" : "drying", step.parameter, total,
                            m_time_left.estimate(step.parameter, total, seconds()),
                            fmt::format("shrinkage {:.3f}, depth {:.2f} t_e", step.shrinkage,
                                        step.depth_rms / m_parameters.fruit.skin_thickness)});
        m_context.log(
            fmt::format("shrinkage {:.5f} newton {} linear {} failed {} depth/t_e {:.4f} energy {:.6g} "
                        "viscous/elastic {:.4f} J {:.3f}",
                        step.shrinkage, step.newton_steps, step.linear_iterations, step.failures,
                        step.depth_rms / m_parameters.fruit.skin_thickness, step.elastic_energy,
                        step.viscous_work / step.elastic_energy, step.smallest_volume_ratio));
        save_when_due();
    }

    void save_when_due() {
        const double since_s = seconds() - m_saved_at_s;
        if (kCheckpointShare * since_s >= m_saving_took_s || since_s > kLongestWithoutCheckpoint_s) save();
    }

    void save() {
        const double began_s = seconds();
        m_sink.set_summary(summary());
        m_sink.save_checkpoint(to_bytes({m_path.state(), m_frames_done, m_elapsed_before_s + seconds()}));
        m_saved_at_s = seconds();
        m_saving_took_s = m_saved_at_s - began_s;
    }

    nlohmann::json summary() {
        const double thickness = m_parameters.fruit.skin_thickness;
        nlohmann::json history = nlohmann::json::object();
        int newton = m_path.state().pending.newton_steps;
        int linear = m_path.state().pending.linear_iterations;
        int failures = m_path.state().pending.failures;
        for (const StepRecord& r : m_path.state().history) {
            if (m_parameters.moisture.on()) history["hours"].push_back(r.parameter);
            history["shrinkage"].push_back(r.shrinkage);
            history["depth_rms_over_te"].push_back(r.depth_rms / thickness);
            history["elastic_energy"].push_back(r.elastic_energy);
            history["viscous_work"].push_back(r.viscous_work);
            history["newton_steps"].push_back(r.newton_steps);
            history["linear_iterations"].push_back(r.linear_iterations);
            history["failures"].push_back(r.failures);
            history["contacts"].push_back(r.contacts);
            newton += r.newton_steps;
            linear += r.linear_iterations;
            failures += r.failures;
        }
        const PhaseTimes& times = m_path.newton().times();
        nlohmann::json result = {
            {"unknowns", m_path.elasticity().size()},
            {"columns", m_path.mesh().columns()},
            {"cells", m_path.mesh().brick.cells},
            {"layers", m_path.mesh().layers},
            {"steps", m_path.state().history.size()},
            {"newton_steps", newton},
            {"linear_iterations", linear},
            {"failures", failures},
            {"elapsed_s", m_elapsed_before_s + seconds()},
            {"peak_memory_bytes", peak_memory_bytes()},
            {"instruction_set", m_path.elasticity().multigrid().table().instruction_set},
            {"seconds",
             {{"assembly", times.assembly_s},
              {"multigrid_setup", times.multigrid_setup_s},
              {"linear_solver", times.linear_solver_s},
              {"energy", times.energy_s}}},
            {"history", history},
        };
        if (m_path.onset() >= 0) result["onset_shrinkage"] = m_path.onset();
        return result;
    }

    DryingParameters m_parameters;
    const ArtistFruit* m_fruit;
    take::FrameSink& m_sink;
    const RunContext& m_context;
    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
    std::vector<double> m_frames;
    DryingPath m_path;
    std::unique_ptr<ArtistSkin> m_artist_skin;  ///< null where the take has the solver's skin
    int m_frames_done = 0;
    double m_elapsed_before_s = 0;
    double m_saved_at_s = 0;
    double m_saving_took_s = 0;
    TimeLeft m_time_left;
};

}  // namespace

void run(const DryingParameters& parameters, take::FrameSink& sink, const RunContext& context,
         std::span<const std::byte> checkpoint) {
    Run(parameters, {}, sink, context, checkpoint).go();
}

void run(const DryingParameters& parameters, const FruitFiles& files, take::FrameSink& sink,
         const RunContext& context, std::span<const std::byte> checkpoint) {
    Run(parameters, files, sink, context, checkpoint).go();
}

}  // namespace windfall::drying
