#include "app/base/Inquiry.h"

#include "app/base/VisibilityWatcher.h"

#include <QLabel>

namespace faintline {

InquiryBase::InquiryBase(QObject *parent) : JobRunner(parent)
{
    connect(this, &JobRunner::progressed, this, [this](double fraction, const QString &what) {
        constexpr qint64 longMs = 300;
        if (m_sentence && m_began.elapsed() > longMs)
            m_sentence->setText(tr("%1, %2 %").arg(what).arg(int(100.0 * fraction)));
    });
}

void InquiryBase::watch(QWidget &panel, QLabel *sentence)
{
    m_sentence = sentence;
    m_sight = new VisibilityWatcher(panel);
    connect(m_sight, &VisibilityWatcher::came, this, &InquiryBase::ask);
}

bool InquiryBase::isSeen() const
{
    return !m_sight || m_sight->isOn();
}

void InquiryBase::begin(Job job)
{
    if (m_pauseMs > 0)
        cancel(); // an answer to the previous question would be mistaken for this one's
    m_whyNot.clear();
    m_began.start();
    start(std::move(job), m_pauseMs);
}

void InquiryBase::say(const QString &whyNot)
{
    m_whyNot = whyNot;
    if (m_sentence)
        m_sentence->setText(whyNot);
    emit changed();
}

} // namespace faintline
