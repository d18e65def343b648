#pragma once

#include "app/base/JobRunner.h"
#include "widgets/base/labelText.h"

#include <QElapsedTimer>

#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

class QLabel;
class QWidget;

namespace faintline {

class VisibilityWatcher;

/// What inquiries of every kind have in common; see `Inquiry`.
class InquiryBase : public JobRunner
{
    Q_OBJECT

public:
    /// Asks only while the panel is seen, and when it comes into sight. Its sentence says why there is no answer, and the
    /// progress of what takes long.
    void watch(QWidget &panel, QLabel *sentence = nullptr);
    /// Waits until the question has been the same for as long.
    void setPause(int ms) { m_pauseMs = ms; }
    /// Asks at each of these signals.
    template <class Sender, class... Signals>
    void askAt(const Sender &sender, Signals... changes)
    {
        (connect(&sender, changes, this, &InquiryBase::ask), ...);
    }

    /// The reason why there is no answer; empty if there is one, or none yet.
    const QString &whyNot() const { return m_whyNot; }

public slots:
    virtual void ask() = 0;

signals:
    void changed(); ///< the answer, or the reason why there is none

protected:
    explicit InquiryBase(QObject *parent);

    bool isSeen() const;
    void begin(Job job);
    void say(const QString &whyNot);

private:
    VisibilityWatcher *m_sight = nullptr;
    QLabel *m_sentence = nullptr;
    int m_pauseMs = 0;
    QElapsedTimer m_began;
    QString m_whyNot;
};

/// A question about a document and its answer, which a panel shows.
///
/// `question` gives it, or the reason why there is none; `compute` answers it on a worker, and knows nothing else; `show`
/// is called in the panel's thread whenever there is another answer, or none. Asked again, it computes nothing if the
/// question is the same; otherwise the newest question replaces the previous one. An answer stays until there is another
/// one or the reason why there is none. To be declared last in its class: its job ends first.
template <class Answer, class... Inputs>
class Inquiry final : public InquiryBase
{
public:
    using Input = std::tuple<Inputs...>;
    /// Nothing: what is shown stays. A sentence: there is no answer, for that reason.
    using Question = std::variant<std::monostate, QString, Input>;
    /// Shows a part of the answer while the rest is computed.
    using Partly = std::function<void(Answer)>;

    /// `question` and `show` are functions or member functions of `parent`. `compute` takes the inputs, a RunContext and,
    /// if the answer has parts, a Partly; `show` may take a pointer to the answer.
    template <class Parent, class Ask, class Compute, class Show>
    Inquiry(Parent *parent, Ask question, Compute compute, Show show)
        : InquiryBase(parent), m_question([=] { return call(question, parent); }),
          m_compute(
              [compute = std::move(compute)](const Input &input, const RunContext &context, const Partly &partly) {
                  const auto answerTo = [&](const Inputs &...inputs) {
                      if constexpr (std::is_invocable_v<Compute, const Inputs &..., const RunContext &>)
                          return compute(inputs..., context);
                      else
                          return compute(inputs..., context, partly);
                  };
                  return std::apply(answerTo, input);
              })
    {
        connect(this, &JobRunner::cancelled, this, [this] { m_asked.reset(); });
        connect(this, &JobRunner::failed, this, [this](const Error &error) { refuse(messageText(error.what())); });
        connect(this, &InquiryBase::changed, parent, [=, this] {
            if constexpr (std::is_invocable_v<Show, Parent *,
                                              const Answer *> || std::is_invocable_v<Show, const Answer *>)
                call(show, parent, answer());
            else
                call(show, parent);
        });
    }

    static Question questionIf(bool isOne, const QString &whyNot, const Inputs &...inputs)
    {
        return isOne ? Question(Input(inputs...)) : Question(whyNot);
    }

    void ask() override
    {
        const Question now = m_question();
        const auto *input = std::get_if<Input>(&now);
        if (input && m_asked && *m_asked == *input)
            return;
        if (input && isSeen()) {
            begin(jobFor(*input));
            m_asked = *input;
            return;
        }
        cancel();
        if (input)
            return;
        m_asked.reset();
        if (const auto *whyNot = std::get_if<QString>(&now))
            refuse(*whyNot);
    }

    /// Null: none.
    const Answer *answer() const { return m_answered ? &m_answered->second : nullptr; }
    /// The answer to a question that begins with this, such as an analysis; null if it is to another one.
    const Answer *answerAbout(const std::tuple_element_t<0, Input> &subject) const
    {
        return m_answered && std::get<0>(m_answered->first) == subject ? answer() : nullptr;
    }
    /// To what the answer is. Precondition: there is one.
    const Input &answered() const { return m_answered->first; }

private:
    using Answered = std::pair<Input, Answer>;

    template <class Function, class Parent, class... Arguments>
    static auto call(const Function &function, Parent *parent, Arguments... arguments)
    {
        if constexpr (std::is_member_function_pointer_v<Function>)
            return (parent->*function)(arguments...);
        else
            return function(arguments...);
    }

    Job jobFor(const Input &asked)
    {
        return [this, input = asked, compute = m_compute](const RunContext &context) -> Delivery {
            const auto delivery = [this, &input](Answer answer) -> Delivery {
                return [this, answered = std::make_shared<const Answered>(input, std::move(answer))] {
                    m_answered = answered;
                    say({});
                };
            };
            return delivery(compute(input, context, [&](Answer part) { deliver(delivery(std::move(part))); }));
        };
    }

    void refuse(const QString &whyNot)
    {
        m_answered.reset();
        say(whyNot);
    }

    std::function<Question()> m_question;
    std::function<Answer(const Input &, const RunContext &, const Partly &)> m_compute;
    std::optional<Input> m_asked; ///< being answered, or answered
    std::shared_ptr<const Answered> m_answered;
};

} // namespace faintline
