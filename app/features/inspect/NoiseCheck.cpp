#include "app/features/inspect/NoiseCheck.h"

#include "app/document/AnalysisController.h"
#include "app/document/RecordingCheck.h"
#include "app/document/statisticUnit.h"
#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include <cmath>

namespace faintline {

namespace {

    QLabel *words()
    {
        auto *label = new QLabel;
        label->setWordWrap(true);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
        label->hide();
        return label;
    }

    /// Makes a sentence of a clause: capital first letter, full stop.
    QString sentence(const std::string &clause)
    {
        return capitalised(QString::fromStdString(clause)) + QLatin1Char('.');
    }

} // namespace

NoiseCheck::NoiseCheck(const Document &document, AnalysisController &controller, RecordingCheck &check, QWidget *parent)
    : QWidget(parent), m_document(document), m_controller(controller), m_check(check), m_warning(words()),
      m_button(new QPushButton), m_progress(new QProgressBar), m_result(words()), m_correct(new QPushButton)
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
    connect(m_correct, &QPushButton::clicked, this, [this] {
        if (const auto after = m_check.corrected())
            m_controller.setSettings(*after, tr("Correct the threshold"));
    });
    connect(&check, &RecordingCheck::changed, this, &NoiseCheck::refresh);
    connect(&check, &RecordingCheck::countProgressed, this, [this](double fraction, const QString &what) {
        m_progress->setValue(int(std::lround(1000.0 * fraction)));
        m_progress->setToolTip(what);
    });
    refresh();
}

void NoiseCheck::toggle()
{
    m_check.isCounting() ? m_check.stopCount() : m_check.startCount();
}

void NoiseCheck::show(const SurrogateCount &count)
{
    m_check.setCount(count);
}

void NoiseCheck::refresh()
{
    setVisible(m_document.recording() != nullptr);
    showWarning();
    showCount();
    showProgress();
}

void NoiseCheck::showWarning()
{
    QStringList sentences;
    if (m_check.law() && !m_check.law()->isFollowed())
        sentences << sentence(m_check.law()->warning());
    for (const Advice &advice : m_check.advice())
        sentences << sentence(advice.remedy.empty() ? advice.sentence : advice.sentence + "; " + advice.remedy);
    m_warning->setText(sentences.join(QLatin1Char('\n')));
    m_warning->setVisible(!sentences.isEmpty());
    QPalette palette = m_warning->palette();
    palette.setColor(QPalette::WindowText, Theme::colours(*this).error);
    m_warning->setPalette(palette);
}

void NoiseCheck::showCount()
{
    m_correct->hide();
    m_result->setVisible(m_check.count() || m_check.failure());
    if (m_check.failure())
        m_result->setText(QString::fromUtf8(m_check.failure()->what()));
    if (!m_check.count())
        return;
    const SurrogateCount &count = *m_check.count();
    QString text = tr("%1 events for %2 specified in %3 h of noise like this recording's: ratio %4 (95 %: %5 to %6).")
                       .arg(count.events)
                       .arg(numberText(count.ordered, 0), numberText(count.hours, 1), numberText(count.ratio, 2),
                            numberText(count.interval.low, 2), numberText(count.interval.high, 2));
    if (const auto after = m_check.corrected()) {
        m_correct->setText(
            tr("Set threshold to %1 %2").arg(numberText(after->decide.thresholdNats, 2), statisticUnit(*after)));
        m_correct->setToolTip(tr("At this threshold the false-alarm rate is as specified"));
        m_correct->show();
    } else {
        text += QLatin1Char(' ') + tr("The threshold gives the specified false-alarm rate here.");
    }
    m_result->setText(text);
}

void NoiseCheck::showProgress()
{
    const bool isCounting = m_check.isCounting();
    if (isCounting && m_progress->isHidden())
        m_progress->setValue(0);
    m_progress->setVisible(isCounting);
    m_button->setText(isCounting ? tr("Stop") : tr("Count on noise like this recording's"));
    m_button->setEnabled(m_document.recording() && m_document.analysis());
}

} // namespace faintline
