#include "report/template.h"

#include "report/formats.h"
#include "report/page_script.h"
#include "report/templates.h"

#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace plumbline::report
{
  namespace
  {
    namespace mustache = kainjow::mustache;

    mustache::data to_mustache(const Data &data)
    {
      if (data.is_object())
      {
        mustache::data object{mustache::data::type::object};
        for (const auto &[key, value] : data.items())
          object.set(key, to_mustache(value));
        return object;
      }
      if (data.is_array())
      {
        mustache::data list{mustache::data::type::list};
        for (const Data &one : data)
          list.push_back(to_mustache(one));
        return list;
      }
      if (data.is_string())
      {
        const auto &text = data.get_ref<const std::string &>();
        return text.empty() ? mustache::data(false) : mustache::data(text);
      }
      if (data.is_number())
        return mustache::data(data.dump());
      return mustache::data(data.is_boolean() && data.get<bool>());
    }

    /// What a template sees: nothing is empty that was only forgotten.
    class Context : public mustache::context<std::string>
    {
    public:
      explicit Context(const mustache::data &data) : mustache::context<std::string>(&data) {}

      const mustache::data *get(const std::string &key) const override
      {
        if (const auto *found = mustache::context<std::string>::get(key))
          return found;
        throw std::logic_error("a template asks for '" + key + "', which is not given");
      }

      const mustache::data *get_partial(const std::string &name) const override
      {
        auto &partial = partials_[name];
        if (!partial)
          partial = std::make_unique<mustache::data>(template_text(name));
        return partial.get();
      }

    private:
      mutable std::map<std::string, std::unique_ptr<mustache::data>> partials_;
    };
  } // namespace

  const std::string &template_text(const std::string &name)
  {
    const auto found = templates().find(name);
    if (found == templates().end())
      throw std::logic_error("there is no template '" + name + "'");
    return found->second;
  }

  std::string fill(const std::string &name, const Data &data)
  {
    return with_script(fill_text(template_text(name), data));
  }

  std::string fill_text(const std::string &text, const Data &data)
  {
    mustache::mustache filled(text);
    filled.set_custom_escape(escape_html);
    const mustache::data all = to_mustache(data);
    Context context(all);
    const std::string result = filled.render(context);
    if (!filled.is_valid())
      throw std::logic_error("template: " + filled.error_message());
    return result;
  }
} // namespace plumbline::report
