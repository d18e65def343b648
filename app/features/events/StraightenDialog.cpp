#include "app/features/events/StraightenDialog.h"

#include "app/base/filePath.h"
#include "app/document/Document.h"
#include "app/document/Provenance.h"
#include "app/document/thresholdWords.h"
#include "base/json.h"
#include "exchange/Session.h"
#include "signal/formats/writeRecording.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ChartPlot.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPointer>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double lowestDb = -15.0; ///< lowest level drawn; nulls of a spectrum may lie far below
    constexpr double fewestFrames = 2.0, mostFrames = 4096.0, usualFrames = 32.0; ///< of smoothing

    QDoubleSpinBox *number(double low, double high, double value, int decimals, const QString &suffix)
    {
        auto *box = new QDoubleSpinBox;
        box->setDecimals(decimals);
        box->setRange(low, high);
        box->setValue(value);
        box->setSuffix(suffix);
        box->setKeyboardTracking(false);
        return box;
    }

    Chart chartOf(const LineSpectrum &spectrum, const std::string &title)
    {
        constexpr std::size_t mostPoints = 2000;
        Chart chart{title, "Frequency (Hz)", "Level (dB over the band's median)", false, false, {}};
        Curve curve{title, Curve::Kind::Measured, {}};
        const std::size_t step = std::max<std::size_t>(1, spectrum.db.size() / mostPoints);
        for (std::size_t i = 0; i < spectrum.db.size(); i += step) {
            const auto first = spectrum.db.begin() + std::ptrdiff_t(i);
            const auto highest =
                std::max_element(first, spectrum.db.begin() + std::ptrdiff_t(std::min(i + step, spectrum.db.size())));
            if (std::isfinite(*highest) || *highest < 0.0)
                curve.points.push_back(
                    {spectrum.hz[std::size_t(highest - spectrum.db.begin())], std::max(*highest, lowestDb), {}});
        }
        chart.curves.push_back(std::move(curve));
        return chart;
    }

    double highestOf(const LineSpectrum &spectrum)
    {
        return *std::max_element(spectrum.db.begin(), spectrum.db.end());
    }

} // namespace

StraightenDialog::StraightenDialog(const Document &document, const Event &event, Provenance &provenance,
                                   QWidget *parent)
    : QDialog(parent), m_analysis(document.analysis()), m_event(event), m_path(document.sourcePath()),
      m_provenance(provenance), m_method(new QComboBox), m_type(new QComboBox), m_sentence(panelSentence()),
      m_before(new ChartPlot), m_after(new ChartPlot), m_progress(new QProgressBar),
      m_write(new QPushButton(tr("&Write recording…"))),
      m_preview(
          this, [this] { return m_preview.questionIf(true, {}, m_analysis, choice()); },
          [event](const auto &analysis, const StraightenChoice &chosen, const RunContext &context) {
              const Straightened straight = straightened(*analysis, event, chosen);
              return Spectra{straight, lineSpectrum(*analysis->recording, straight.before, context.part(0.0, 0.4)),
                             lineSpectrum(*straight.recording, straight.after, context.part(0.4, 1.0))};
          },
          &StraightenDialog::show)
{
    setWindowTitle(tr("Straighten the recording along event %1").arg(event.id));
    buildInputs();
    buildLayout();
    connectInputs();
    m_preview.ask();
}

void StraightenDialog::buildInputs()
{
    const RecordingInfo &info = m_analysis->recording->info();
    const double frame = m_analysis->time().step;
    const double half = 0.5 * info.sampleRateHz;
    m_target = number(info.isComplex ? -half : 0.0, half, 0.0, 3, tr(" Hz"));
    m_target->setToolTip(tr("Frequency of the straightened line; default: mean frequency of the track"));
    m_target->setEnabled(false); // until the track's mean is known
    m_method->addItem(tr("Shift the band with the line"));
    m_method->addItem(tr("Resample along the line"));
    m_method->setToolTip(tr("A shift keeps one line constant and the noise as it was; resampling keeps all multiples "
                            "of the line constant and changes the duration. Default: resample for harmonics"));
    m_method->setCurrentIndex(int(usualStraightening(*m_analysis)));
    m_smoothing =
        number(fewestFrames * frame, mostFrames * frame, usualFrames * frame, decimalsFor(0.1 * frame), tr(" s"));
    m_smoothing->setToolTip(tr("Smoothing halves frequency variations of this period; default: 32 frames"));
    m_usualSmoothing = m_smoothing->value();
    m_type->addItem(tr("32-bit float"), int(WrittenType::Float32));
    m_type->addItem(tr("16-bit integer"), int(WrittenType::Int16));
    m_sentence->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_progress->setRange(0, 1000);
    m_progress->setAccessibleName(tr("Progress"));
    m_progress->hide();
    for (ChartPlot *chart : {m_before, m_after})
        chart->setEmptySentence(tr("The spectrum of the line's duration appears here."));
}

void StraightenDialog::buildLayout()
{
    auto *form = new QFormLayout;
    form->addRow(tr("&Line at"), m_target);
    form->addRow(tr("S&moothing"), m_smoothing);
    form->addRow(tr("M&ethod"), m_method);
    form->addRow(tr("Sam&ples"), m_type);
    auto *charts = new QHBoxLayout;
    charts->addWidget(m_before);
    charts->addWidget(m_after);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->addButton(m_write, QDialogButtonBox::ActionRole);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto *layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addLayout(charts, 1);
    layout->addWidget(m_sentence);
    layout->addWidget(m_progress);
    layout->addWidget(buttons);
    resize(920, 480);
}

void StraightenDialog::connectInputs()
{
    for (const QDoubleSpinBox *box : {m_target, m_smoothing})
        m_preview.askAt(*box, &QDoubleSpinBox::valueChanged);
    m_preview.askAt(*m_method, &QComboBox::currentIndexChanged);
    connect(m_write, &QPushButton::clicked, this, [this] { m_writer.isRunning() ? m_writer.cancel() : ask(); });
    connect(&m_writer, &JobRunner::progressed, this,
            [this](double fraction, const QString &) { m_progress->setValue(int(1000.0 * fraction)); });
    connect(&m_writer, &JobRunner::busyChanged, this, &StraightenDialog::showWriting);
    connect(&m_writer, &JobRunner::cancelled, this,
            [this] { m_sentence->setText(tr("Stopped; no file was written.")); });
    connect(&m_writer, &JobRunner::failed, this, &StraightenDialog::say);
}

StraightenChoice StraightenDialog::choice() const
{
    StraightenChoice choice;
    if (m_smoothing->value() != m_usualSmoothing)
        choice.smoothingSeconds = m_smoothing->value();
    if (m_usualTarget && m_target->value() != *m_usualTarget)
        choice.targetHz = m_target->value();
    if (const auto kind = Straightening(m_method->currentIndex()); kind != usualStraightening(*m_analysis))
        choice.kind = kind;
    return choice;
}

void StraightenDialog::showWriting(bool isWriting)
{
    m_progress->setVisible(isWriting);
    m_write->setText(isWriting ? tr("&Stop") : tr("&Write recording…"));
    for (QWidget *input : std::initializer_list<QWidget *>{m_smoothing, m_method, m_type})
        input->setEnabled(!isWriting);
    m_target->setEnabled(!isWriting && m_usualTarget);
}

void StraightenDialog::say(const Error &error)
{
    m_sentence->setText(messageText(error.what()));
}

/// Shows the default target unless it is already known.
void StraightenDialog::showTarget(double hz)
{
    if (m_usualTarget)
        return;
    const QSignalBlocker blocker(m_target);
    m_target->setValue(hz);
    m_target->setEnabled(true);
    m_usualTarget = m_target->value();
}

void StraightenDialog::show(const Spectra *made)
{
    if (!made) { // outdated by changed inputs
        for (ChartPlot *chart : {m_before, m_after})
            chart->setChart({});
        return m_sentence->setText(m_preview.whyNot());
    }
    const Spectra &spectra = *made;
    showTarget(spectra.straightened.targetHz);
    const std::vector<double> &hz = spectra.straightened.curve.hz();
    const auto [least, most] = std::minmax_element(hz.begin(), hz.end());
    const TimeBand &stretch = spectra.straightened.before;
    const double was = highestOf(spectra.before), is = highestOf(spectra.after);
    const double resolution = std::min(0.01, 0.1 * m_analysis->grid().axes.back().step);
    QString words = tr("Event %1: %2 … %3, %4 … %5, straightened at %6. ")
                        .arg(m_event.id)
                        .arg(secondsText(m_event.onsetSeconds, 0.1), secondsText(m_event.endSeconds, 0.1),
                             hertzText(*least, resolution), hertzText(*most, resolution),
                             hertzText(spectra.straightened.targetHz, resolution));
    words +=
        std::isfinite(was) && std::isfinite(is)
            ? tr("In one spectrum of its %1 the line stands %2 dB over its surroundings before, %3 dB after.")
                  .arg(secondsText(stretch.toSeconds - stretch.fromSeconds, 0.1), numberText(was, 1), numberText(is, 1))
            : tr("Its surroundings are silent.");
    m_sentence->setText(words);
    m_before->setChart(chartOf(spectra.before, "Before"));
    m_after->setChart(chartOf(spectra.after, "After"));
    for (ChartPlot *chart : {m_before, m_after})
        chart->setLeastOrdinates(
            std::isfinite(was) && std::isfinite(is) ? std::optional(Span{lowestDb, std::max(was, is)}) : std::nullopt);
}

void StraightenDialog::ask()
{
    const bool isComplex = m_analysis->recording->info().isComplex;
    const QString audio = tr("Audio (*.wav *.flac *.aiff *.caf *.au *.w64 *.rf64)");
    const QString sigmf = tr("SigMF (*.sigmf-meta)");
    const QString path = QFileDialog::getSaveFileName(
        this, tr("Write straightened recording"),
        nameBeside(m_path, isComplex ? QStringLiteral("-straight.sigmf-meta") : QStringLiteral("-straight.wav")),
        isComplex ? sigmf + QStringLiteral(";;") + audio : audio + QStringLiteral(";;") + sigmf);
    if (!path.isEmpty())
        writeTo(path);
}

void StraightenDialog::writeTo(const QString &path)
{
    if (m_analysis->calibration->isFirstEstimate)
        return say(firstEstimateError());
    try {
        checkReplacesNoInput(pathBytes(path));
    } catch (const Error &error) {
        return say(error);
    }
    const auto type = WrittenType(m_type->currentData().toInt());
    m_writer.start([this, path, analysis = m_analysis, event = m_event, chosen = choice(),
                    type](const RunContext &context) -> JobRunner::Delivery {
        const Straightened straight = straightened(*analysis, event, chosen);
        writeRecording(*straight.recording, pathBytes(path), type, context);
        return [this, path] { finish(path); };
    });
}

/// Records the file's origin in a file beside it.
void StraightenDialog::finish(const QString &path)
{
    const StraightenChoice chosen = choice();
    Json made = {{"event", m_event.id}, {"type", m_type->currentIndex() == 0 ? "float32" : "int16"}};
    if (chosen.smoothingSeconds != 0.0)
        made["smoothSeconds"] = chosen.smoothingSeconds;
    if (chosen.targetHz)
        made["targetHz"] = *chosen.targetHz;
    if (chosen.kind)
        made["method"] = straighteningNames[std::size_t(*chosen.kind)];
    m_provenance.with([self = QPointer(this), path, made](const std::string &provenance) {
        try {
            Json json = parseJson(provenance, "provenance");
            json["straighten"] = made;
            writeProvenanceBeside(path, json.dump(2) + "\n");
        } catch (const Error &error) {
            if (self)
                self->say(error);
            return;
        }
        if (!self)
            return;
        self->m_sentence->setText(tr("Wrote %1.").arg(fileLabel(path)));
        emit self->written(path);
    });
}

} // namespace faintline
