#include "app/features/settings/LearnMotionDialog.h"

#include "app/document/AnalysisController.h"
#include "base/Error.h"
#include "widgets/base/labelText.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

namespace faintline {

namespace {

    QString lawText(const std::vector<double> &law)
    {
        QStringList values;
        for (std::size_t i = 0; i < law.size(); ++i)
            values << QStringLiteral("h(%1) = %2").arg(i).arg(law[i], 0, 'f', 3);
        return values.join(QStringLiteral(", "));
    }

    QString row(const QString &name, const QString &present, const QString &learned)
    {
        return QStringLiteral("<tr><td>%1&nbsp;&nbsp;</td><td>%2&nbsp;&nbsp;</td><td>%3</td></tr>")
            .arg(name, present, learned);
    }

    QString nats(double value)
    {
        return QObject::tr("%1 nat").arg(value, 0, 'f', 2);
    }

} // namespace

LearnMotionDialog::LearnMotionDialog(std::shared_ptr<const Analysis> analysis, AnalysisController &controller,
                                     QWidget *parent)
    : QDialog(parent), m_analysis(std::move(analysis)), m_controller(controller),
      m_words(new QLabel(tr("Learning from the tracks …"))), m_progress(new QProgressBar),
      m_motion(
          this, [this] { return m_motion.questionIf(true, {}, m_analysis); },
          [](const auto &learnedFrom, const RunContext &context) { return learnMotion(*learnedFrom, context); },
          &LearnMotionDialog::show)
{
    setWindowTitle(tr("Learn motion from tracks"));
    m_words->setObjectName(QStringLiteral("learnedMotion"));
    m_words->setTextFormat(Qt::RichText);
    m_words->setWordWrap(true);
    m_words->setFixedWidth(460);
    m_progress->setRange(0, 1000);
    m_progress->setAccessibleName(tr("Progress"));
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    m_apply = buttons->addButton(tr("&Apply learned law"), QDialogButtonBox::AcceptRole);
    m_apply->setObjectName(QStringLiteral("applyLearnedMotion"));
    m_apply->setEnabled(false);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(m_words);
    layout->addWidget(m_progress);
    layout->addWidget(buttons);

    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, &LearnMotionDialog::apply);
    connect(&m_motion, &JobRunner::progressed, this,
            [this](double fraction, const QString &) { m_progress->setValue(int(1000.0 * fraction)); });
    connect(&m_motion, &JobRunner::failed, this,
            [this](const Error &error) { m_words->setText(messageText(error.why()).toHtmlEscaped()); });
    m_motion.ask();
}

void LearnMotionDialog::show(const LearnedMotion *learned)
{
    m_progress->hide();
    m_apply->setEnabled(learned);
    if (!learned)
        return;
    const LearnedMotion &motion = *learned;
    const QString learnedFrom =
        tr("From %n track(s), %1 frames.", nullptr, int(motion.tracks)).arg(motion.frames, 0, 'f', 0);
    const QString table = row(QString(), tr("<b>present</b>"), tr("<b>learned</b>"))
                          + row(tr("Slope changes"), lawText(motion.present), lawText(motion.learned))
                          + row(tr("ln K"), nats(motion.presentLnK), nats(motion.learnedLnK))
                          + row(tr("Threshold"), nats(motion.presentThreshold), nats(motion.learnedThreshold));
    const QString gain =
        tr("Gain of the learned law over the threshold: %1 nat for a path of 25 frames, %2 nat for one of 100 frames.")
            .arg(motion.gainOver(25.0), 0, 'f', 1)
            .arg(motion.gainOver(100.0), 0, 'f', 1);
    m_words->setText(QStringLiteral("<p>%1</p><table>%2</table><p>%3</p>").arg(learnedFrom, table, gain));
    m_words->setFixedHeight(m_words->heightForWidth(m_words->width()));
    adjustSize();
}

void LearnMotionDialog::apply()
{
    m_controller.setSettings(withLearnedMotion(*m_analysis, *m_motion.answer()), tr("Apply learned motion"));
    accept();
}

} // namespace faintline
