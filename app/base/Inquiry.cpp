#include "app/base/Inquiry.h"

#include "app/base/VisibilityWatcher.h"
#include "widgets/base/labelText.h"

#include <QLabel>

namespace faintline {

InquiryBase::InquiryBase(QObject *parent) : JobRunner(parent)
{
    connect(this, &JobRunner::cancelled, this, &InquiryBase::forgetQuestion);
    connect(this, &JobRunner::failed, this, [this](const Error &error) {
        forgetAnswer();
        say(messageText(error.what()));
    });
    connect(this, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        constexpr qint64 longMs = 300;
        if (m_label && m_began.elapsed() > longMs)
            m_label->setText(tr("%1, %2 %").arg(what).arg(int(100.0 * fraction)));
    });
}

void InquiryBase::watch(QWidget &panel)
{
    m_sight = new VisibilityWatcher(panel);
    connect(m_sight, &VisibilityWatcher::came, this, &InquiryBase::ask);
}

void InquiryBase::ask()
{
    QString whyNot;
    const Found found = read(whyNot);
    if (found == Found::Known)
        return;
    if (found == Found::New && (!m_sight || m_sight->isOn())) {
        m_whyNot.clear();
        m_began.start();
        return start(job(), m_pauseMs);
    }
    cancel();
    if (found == Found::New)
        return;
    forgetQuestion();
    if (found == Found::Nothing)
        return;
    forgetAnswer();
    say(whyNot);
}

void InquiryBase::say(const QString &whyNot)
{
    m_whyNot = whyNot;
    if (m_label)
        m_label->setText(whyNot);
    emit changed();
}

} // namespace faintline
