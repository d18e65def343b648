#include "app/panels/NoiseCheck.h"

#include "analysis/noiseLaw.h"
#include "app/base/statisticUnit.h"
#include "app/control/AnalysisController.h"
#include "base/Error.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double wantedHours = 2.0; ///< of noise, in all
    constexpr int mostRuns = 40;

    /// As many as make up two hours, four at least.
    int runsFor(const Analysis &analysis)
    {
        const double hours = static_cast<double>(analysis.time().count) * analysis.time().step / 3600.0;
        return std::clamp(static_cast<int>(std::ceil(wantedHours / hours)), 4, mostRuns);
    }

    QLabel *words()
    {
        auto *label = new QLabel;
        label->setWordWrap(true);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
        label->hide();
        return label;
    }

} // namespace

NoiseCheck::NoiseCheck(const Document &document, AnalysisController &controller, QWidget *parent)
    : QWidget(parent), m_document(document), m_controller(controller), m_warning(words()), m_button(new QPushButton),
      m_progress(new QProgressBar), m_result(words()), m_correct(new QPushButton)
{
    m_warning->setObjectName(QStringLiteral("noiseWarning"));
    m_result->setObjectName(QStringLiteral("surrogateResult"));
    m_button->setObjectName(QStringLiteral("countOnSurrogates"));
    m_correct->setObjectName(QStringLiteral("correctThreshold"));
    m_correct->setAccessibleName(tr("Correct the threshold"));
    m_button->setToolTip(tr("Simulates noise with the length, spectrum, levels and gaps of this recording, analyses it "
                            "with the same settings and counts the events: actual false alarms per false alarm "
                            "specified"));
    m_progress->setRange(0, 1000);
    m_progress->setTextVisible(false);
    m_progress->setFixedHeight(6);
    m_progress->setAccessibleName(tr("Progress of the count"));
    m_progress->hide();
    m_correct->hide();

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(10, 2, 10, 8);
    layout->setSpacing(4);
    layout->addWidget(m_warning);
    auto *line = new QHBoxLayout;
    line->addWidget(m_button);
    line->addWidget(m_correct);
    line->addStretch(1);
    layout->addLayout(line);
    layout->addWidget(m_progress);
    layout->addWidget(m_result);

    connect(m_button, &QPushButton::clicked, this, &NoiseCheck::toggle);
    connect(m_correct, &QPushButton::clicked, this, &NoiseCheck::correct);
    connect(&m_runner, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        m_progress->setValue(static_cast<int>(std::lround(1000.0 * fraction)));
        m_progress->setToolTip(what);
    });
    connect(&m_runner, &JobRunner::finished, this, &NoiseCheck::end);
    connect(&m_runner, &JobRunner::cancelled, this, &NoiseCheck::end);
    connect(&m_runner, &JobRunner::failed, this, [this](const Error &error) {
        m_result->setText(QString::fromUtf8(error.what()));
        m_result->show();
        end();
    });
    connect(&m_lawRunner, &JobRunner::finished, this, &NoiseCheck::end);
    connect(&m_lawRunner, &JobRunner::cancelled, this, &NoiseCheck::end);
    connect(&m_lawRunner, &JobRunner::failed, this, &NoiseCheck::end);
    connect(&document, &Document::opened, this, &NoiseCheck::follow);
    connect(&document, &Document::settingsChanged, this, &NoiseCheck::follow);
    connect(&document, &Document::analysisChanged, this, &NoiseCheck::lookAtTheLaw);
    follow();
}

/// What was said of other settings holds no longer.
void NoiseCheck::follow()
{
    if (m_runner.isRunning())
        m_runner.cancel();
    if (m_lawRunner.isRunning())
        m_lawRunner.cancel();
    m_warning->hide();
    m_result->hide();
    m_correct->hide();
    setVisible(m_document.recording() != nullptr);
    end();
}

void NoiseCheck::lookAtTheLaw()
{
    follow();
    if (!m_document.recording())
        return;
    m_lawRunner.start([this, analysis = m_document.analysis()](const RunContext &context) -> JobRunner::Delivery {
        const std::optional<NoiseLaw> law = checkNoiseLaw(*analysis, context);
        return [this, law] {
            QString text = law ? QString::fromStdString(law->warning()) : QString();
            if (text.isEmpty())
                return;
            text[0] = text[0].toUpper();
            m_warning->setText(text + QLatin1Char('.'));
            QPalette palette = m_warning->palette();
            palette.setColor(QPalette::WindowText, Theme::colours(*this).error);
            m_warning->setPalette(palette);
            m_warning->show();
        };
    });
}

void NoiseCheck::toggle()
{
    m_runner.isRunning() ? m_runner.cancel() : count();
}

void NoiseCheck::count()
{
    if (!m_document.recording() || !m_document.analysis() || !m_document.isCurrent())
        return;
    m_result->hide();
    m_correct->hide();
    m_runner.start([this, analysis = m_document.analysis()](const RunContext &context) -> JobRunner::Delivery {
        const SurrogateCount counted =
            countOnSurrogates(analysis->recording, analysis->settings, runsFor(*analysis), context);
        return [this, counted] { show(counted); };
    });
    m_button->setText(tr("Stop"));
    m_progress->setValue(0);
    m_progress->show();
}

void NoiseCheck::show(const SurrogateCount &count)
{
    const Analysis &analysis = *m_document.analysis();
    QString text = tr("%1 events for %2 specified in %3 h of noise like this recording's: ratio %4 (95 %: %5 to %6).")
                       .arg(count.events)
                       .arg(numberText(count.ordered, 0), numberText(count.hours, 1), numberText(count.ratio, 2),
                            numberText(count.interval.low, 2), numberText(count.interval.high, 2));
    if (count.correction == 0.0) {
        text += QLatin1Char(' ') + tr("The threshold gives the specified false-alarm rate here.");
    } else {
        m_correctedNats = analysis.threshold + count.correction;
        m_correct->setText(
            tr("Set threshold to %1 %2").arg(numberText(m_correctedNats, 2), statisticUnit(analysis.settings)));
        m_correct->setToolTip(tr("At this threshold the false-alarm rate is as specified"));
        m_correct->show();
    }
    m_result->setText(text);
    m_result->show();
}

void NoiseCheck::correct()
{
    AnalysisSettings after = m_document.settings();
    after.decide.by = DecideSettings::By::Nats;
    after.decide.thresholdNats = std::round(100.0 * m_correctedNats) / 100.0;
    m_controller.setSettings(after, tr("Correct the threshold"));
}

void NoiseCheck::end()
{
    if (!m_runner.isRunning()) {
        m_button->setText(tr("Count on noise like this recording's"));
        m_button->setEnabled(m_document.recording() && m_document.analysis());
        m_progress->hide();
    }
    if (!isBusy())
        emit settled();
}

} // namespace faintline
